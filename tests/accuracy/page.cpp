#include "tests/accuracy/page.h"

#include <algorithm>
#include <cmath>

namespace hemitex::accuracy {
namespace {

using Row = std::vector<std::string>;

/// Of a closed form whose last bit happens to be right, too.
constexpr double rounding = 1e-16;

std::string line(const Row& cells) {
  std::string text = "|";
  for (const std::string& cell : cells) text += " " + cell + " |";
  return text + "\n";
}

std::string table(const Row& columns, const std::vector<Row>& rows) {
  std::string text = line(columns) + "|" + [&] {
    std::string rule;
    for (std::size_t i = 0; i < columns.size(); ++i) rule += "---|";
    return rule;
  }() + "\n";
  for (const Row& row : rows) text += line(row);
  return text + "\n";
}

std::string sectionOf(const std::string& title, const std::string& text, const std::string& rest) {
  return headline(title) + "\n" + (text.empty() ? "" : text + "\n\n") + rest;
}

std::string yesNo(bool value) { return value ? "yes" : "no"; }

template <typename Cases, typename Finding>
std::string measured(const Cases& cases, Finding findingsOfOne) {
  std::vector<decltype(findingsOfOne(cases.front()))> findings;
  for (const auto& example : cases) findings.push_back(findingsOfOne(example));
  return section(cases, findings);
}

std::string measuredTheme(const FormFactorTheme& theme) {
  std::vector<FormFactorAnswers> answers;
  for (const FormFactorCase& extreme : theme.cases) answers.push_back(answersTo(extreme));
  return section(theme, answers);
}

}  // namespace

std::string headline(const std::string& title) { return "## " + title + "\n"; }

std::string introduction() {
  const std::string samples = std::to_string(raySamples), pixels = std::to_string(hemicubeResolution);
  return R"(# Accuracy at the extremes

What hemitex gives where scenes are at their worst, against what is known exactly. The program `hemitex_accuracy`
(tests/accuracy) wrote this page:

    cmake --build --preset release --target hemitex_accuracy
    build/release/bin/hemitex_accuracy docs/accuracy.md

tests/system/accuracy_test.cpp measures every section again, and fails where the page says something else or where an error is
larger than it has a reason to be.

Tables of form factors say how far each value is from the exact one, relative to it (in parts of all light where it is
0), rounded up to one digit. `0` is exactly 0; `1` means that all of it is missing.

- *closed form*: `polygonToPolygon`, which `--method analytic` adds up. It does not look at blockers.
- *aimed rays*, *rays*: `--method rays`, with `--aimed` and over the hemisphere; )" +
         samples + R"( samples, an eighth of what the
  program takes unless told otherwise. Sixteen times the samples divide the errors of rays over the hemisphere by more
  than 4, those of aimed rays without blockers by more than 12. Every value also comes with its standard error; unless a
  section says otherwise these are within four of them.
- *hemicube*: one, over the centre, of )" +
         pixels + " x " + pixels + R"( pixels. *8 x 8*: the mean of so many, evenly over the surface
  (`--texels 8 --patch 1`). *Their pixels*: the part of the error of the 8 x 8 that comes from pixels; the rest is that
  of closed forms from the same 64 points.

Hemicubes see little of what is smaller than a pixel, and one centre is a poor average of what is near. More pixels mend
the first, smaller patches the second.

)";
}

std::string section(const FormFactorTheme& theme, const std::vector<FormFactorAnswers>& answers) {
  std::vector<Row> rows;
  for (std::size_t i = 0; i < theme.cases.size(); ++i) {
    const FormFactorCase& extreme = theme.cases[i];
    const FormFactorAnswers& answer = answers[i];
    const auto error = [&](double value) { return errorText(errorOf(value, extreme)); };
    const double pixels = std::abs(answer.many.hemicubes - answer.many.closedForm);
    rows.push_back({extreme.name, extreme.truth, numberText(extreme.exact),
                    extreme.isBlocked ? "-" : errorText(std::max(rounding, errorOf(answer.closedForm, extreme))),
                    error(answer.aimed.value), error(answer.hemisphere.value), error(answer.one.hemicubes),
                    error(answer.many.hemicubes), extreme.isBlocked ? "-" : errorText(pixels / extreme.exact)});
  }
  return sectionOf(theme.title, theme.text,
                   table({"case", "exact by", "form factor", "closed form", "aimed rays", "rays", "hemicube", "8 x 8",
                          "their pixels"},
                         rows));
}

std::string section(const std::vector<FurnaceCase>& cases, const std::vector<FurnaceFindings>& findings) {
  std::vector<Row> rows;
  for (std::size_t i = 0; i < cases.size(); ++i)
    rows.push_back({numberText(cases[i].reflectance), std::to_string(findings[i].shots),
                    errorText(findings[i].meanError), errorText(findings[i].accountError), yesNo(findings[i].grew)});
  return sectionOf(
      "Reflectance",
      R"(A closed cube that emits 1 everywhere and reflects r, solved to the default residual of 0.001. Its mean radiosity is
(1 - r residual) / (1 - r) whatever its form factors: rows sum to exactly 1, and flux is neither made nor lost. In a
closed scene the number of shots grows with 1 / (1 - r).)",
      table({"r", "shots", "mean radiosity", "absorbed + unshot + lost = emitted", "unshot flux ever grew"}, rows));
}

std::string section(const std::vector<EmissionCase>& cases, const std::vector<EmissionFindings>& findings) {
  std::vector<Row> rows;
  for (std::size_t i = 0; i < cases.size(); ++i)
    rows.push_back({numberText(cases[i].emission), numberText(cases[i].share), errorText(findings[i].linearityError),
                    errorText(findings[i].accountError)});
  return sectionOf(
      "Emission",
      R"(A light in a closed cube of reflectance 0.5. Radiosity is linear in the emission: over it, every element's is that of an
emission of 1.)",
      table({"emission", "the light's share of all area", "linear", "absorbed + unshot + lost = emitted"}, rows));
}

std::string section(const std::vector<IdCase>& cases) {
  std::vector<Row> rows;
  for (const IdCase& example : cases)
    rows.push_back(
        {std::to_string(example.indexBits), example.format, std::to_string(example.surfaces), example.refusal});
  return sectionOf(
      "Index bits and full words",
      R"(Surfaces of 2^k texels fill a word to its last bit: all of them but two texels of the last surface, whose words are
reserved. Every word then stands for its texel, and for no other: exact. With one texel more the user is told so. Index
maps have at most 4096 x 4096 texels, so k is at most 24 in a scene; words are laid out and drawn rightly for all of
these.)",
      table({"k", "format", "surfaces", "one texel too many"}, rows));
}

std::string section(const OneSurfaceFindings& findings) {
  return sectionOf(
      "One surface", "A square alone, which emits. All its light leaves the scene: exactly 1 of it.",
      table({"light that leaves, by", "error"}, {{"hemicube", errorText(std::abs(findings.backgroundOfHemicube - 1))},
                                                 {"rays", errorText(std::abs(findings.backgroundOfRays - 1))},
                                                 {"the solution's account", errorText(std::abs(findings.lost - 1))}}));
}

std::string section(const MillionFindings& findings) {
  return sectionOf(
      "A million surfaces",
      R"(A floor under a ceiling of 1000 x 1000 surfaces less one, one side away. It takes gigabytes, so it is measured by hand
(`cmake --build --preset release --target million_surfaces`) and not on every change. What reaches all of them is what
would reach the one that they are cut from.)",
      table({"surfaces", "exact by", "rays", "hemicube, against the closed form from its centre",
             "every pixel accounted for, none a back"},
            {{std::to_string(findings.surfaces), "Ehlert and Smith 1993", errorText(findings.hemisphereError),
              errorText(findings.hemicubeError), yesNo(findings.isWhole)}}));
}

std::string section(const std::vector<LimitCase>& cases) {
  std::vector<Row> rows;
  for (const LimitCase& example : cases)
    rows.push_back({example.name, example.limit, example.isError ? "error" : "warning", example.message});
  return sectionOf("Limits and their messages",
                   "An error ends the program with exit code 2, nothing written; after a warning it goes on.",
                   table({"case", "limit", "kind", "message"}, rows));
}

const std::vector<Section>& sections() {
  static const std::vector<Section> all{
      {"Gaps", [] { return measuredTheme(gaps()); }},
      {"Slivers", [] { return measuredTheme(slivers()); }},
      {"Shared edges and touching corners", [] { return measuredTheme(touching()); }},
      {"Dihedral angles", [] { return measuredTheme(angles()); }},
      {"Blockers of zero thickness", [] { return measuredTheme(blockers()); }},
      {"Coincident and interpenetrating surfaces", [] { return measuredTheme(coincident()); }},
      {"Scaled and moved scenes", [] { return measuredTheme(scaledAndMoved()); }},
      {"Emitters of 1e-8 of the scene's area", [] { return measuredTheme(smallEmitters()); }},
      {"Reflectance", [] { return measured(furnaces(), [](const FurnaceCase& c) { return findingsOf(c); }); }},
      {"Emission", [] { return measured(emissions(), [](const EmissionCase& c) { return findingsOf(c); }); }},
      {"One surface", [] { return section(ofOneSurface()); }},
      {"A million surfaces", [] { return section(ofAMillionSurfaces()); }},
      {"Index bits and full words", [] { return section(idCases()); }},
      {"Limits and their messages", [] { return section(limitCases()); }}};
  return all;
}

}  // namespace hemitex::accuracy
