#include "tests/accuracy/page.h"

#include <algorithm>
#include <cmath>

namespace hemitex::accuracy {
namespace {

using Row = std::vector<std::string>;

/// Also for a closed form whose last bit happens to be right.
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

This page compares hemitex with exact results in extreme scenes. The program `hemitex_accuracy` (`tests/accuracy`)
writes it:

    cmake --build --preset release --target hemitex_accuracy
    build/release/bin/hemitex_accuracy docs/accuracy.md

`tests/system/accuracy_test.cpp` measures all sections again. It fails where the page differs or where an error is
larger than its bound.

Tables of form factors show the error of each value relative to the exact value, rounded up to one digit. Where the
exact value is 0, the error is a share of all light. `0` is exactly 0; `1` means that all light is missing.

- *closed form*: `polygonToPolygon`, which `--method analytic` sums. It ignores blockers.
- *aimed rays*, *rays*: `--method rays`, with `--aimed` and over the hemisphere, with )" +
         samples + R"( samples (an eighth of
  the default). Sixteen times the samples divide the errors of rays over the hemisphere by more than 4. They divide the
  errors of aimed rays without blockers by more than 12. Each value has a standard error, which is above its error on
  average. Unless a section says otherwise, errors are within four standard errors.
- *hemicube*: one hemicube over the centre, with )" +
         pixels + " x " + pixels + R"( pixels.
- *8 x 8*: the mean of 64 hemicubes, evenly over the surface (`--texels 8 --patch 1`).
- *their pixels*: the part of the error of *8 x 8* that comes from pixels. The rest is the error of closed forms from
  the same 64 points.

Hemicubes miss most objects smaller than a pixel, and one centre represents near objects badly. More pixels reduce the
first error, smaller patches the second.

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
      R"(A closed cube emits 1 everywhere and reflects r. It is solved to the default residual of 0.001. Its mean radiosity is
(1 - r residual) / (1 - r) for any form factors: rows sum to exactly 1, and no flux is gained or lost. In a closed scene
the number of shots grows with 1 / (1 - r).)",
      table({"r", "shots", "mean radiosity", "absorbed + unshot + lost = emitted", "unshot flux ever grew"}, rows));
}

std::string section(const std::vector<EmissionCase>& cases, const std::vector<EmissionFindings>& findings) {
  std::vector<Row> rows;
  for (std::size_t i = 0; i < cases.size(); ++i)
    rows.push_back({numberText(cases[i].emission), numberText(cases[i].share), errorText(findings[i].linearityError),
                    errorText(findings[i].accountError)});
  return sectionOf(
      "Emission",
      R"(A light in a closed cube of reflectance 0.5. Radiosity is linear in the emission: divided by the emission, the radiosity
of each element equals that for an emission of 1.)",
      table({"emission", "the light's share of all area", "linear", "absorbed + unshot + lost = emitted"}, rows));
}

std::string section(const std::vector<IdCase>& cases) {
  std::vector<Row> rows;
  for (const IdCase& example : cases)
    rows.push_back(
        {std::to_string(example.indexBits), example.format, std::to_string(example.surfaces), example.refusal});
  return sectionOf(
      "Index bits and all item IDs",
      R"(Surfaces of 2^k texels use all item IDs of a format, except for two reserved ones at the end of the last surface. Each
item ID then belongs to exactly one texel. One texel more is an error with the message below. Index maps have at most
4096 x 4096 texels, so k is at most 24 in a scene. Item IDs are laid out and drawn correctly for all of these.)",
      table({"k", "format", "surfaces", "one texel too many"}, rows));
}

std::string section(const OneSurfaceFindings& findings) {
  return sectionOf(
      "One surface", "A single square emits. All its light leaves the scene: a share of exactly 1.",
      table({"light that leaves, by", "error"}, {{"hemicube", errorText(std::abs(findings.backgroundOfHemicube - 1))},
                                                 {"rays", errorText(std::abs(findings.backgroundOfRays - 1))},
                                                 {"the solution's account", errorText(std::abs(findings.lost - 1))}}));
}

std::string section(const MillionFindings& findings) {
  return sectionOf(
      "A million surfaces",
      R"(A floor lies one side below a ceiling of 1000 x 1000 - 1 surfaces. The case needs gigabytes of memory and is measured by
hand only (`cmake --build --preset release --target million_surfaces`). The whole ceiling receives the same light as one
undivided surface.)",
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
                   "After an error the program writes nothing and ends with exit code 2. After a warning it continues.",
                   table({"case", "limit", "kind", "message"}, rows));
}

std::string errorBoundSection() {
  return sectionOf(
      "A bound on the error",
      R"(`solve --max-error` in 30 random rooms with default elements. The rooms have lamps, furniture and 1674 to 4831 elements.
The truth is light tracing with 2^24 paths. The error is the larger one of
[two](light.md#a-bound-on-the-error): of all light, and of the surfaces that the default camera sees. The cost is the
processor time of one thread, with all solutions that choose the settings. It is divided by that of the cheapest setting
of `tradeoff` that keeps the bound, which has to be known. It may be below 1, because `tradeoff` always shoots until 0.01 %
of the flux is unshot. The measurement takes about 30 minutes and is made by hand only:

    cmake --build build/release --target hemitex_error_bounds hemitex_data
    mkdir rooms && build/release/bin/hemitex_data rooms --rooms 30
    taskset -c 0 build/release/bin/hemitex_error_bounds rooms/*.obj)",
      table(
          {"bound", "kept in rooms", "error, median", "largest", "cost over the cheapest setting, median", "largest"},
          {{"3 %", "30 of 30", "1.3 %", "2.1 %", "0.51", "6.5"}, {"1 %", "30 of 30", "0.64 %", "0.84 %", "1.7", "3"}}));
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
      {"Index bits and all item IDs", [] { return section(idCases()); }},
      {"Limits and their messages", [] { return section(limitCases()); }},
      {"A bound on the error", [] { return errorBoundSection(); }}};
  return all;
}

}  // namespace hemitex::accuracy
