// docs/accuracy.md: measures all sections again, and compares them with error bounds and with the page.
#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <sstream>

#include "raster/software/software_renderer.h"
#include "reference/conformance/vectors/draw_list_builder.h"
#include "tests/accuracy/page.h"

using namespace hemitex;
using namespace hemitex::accuracy;

namespace {

std::string committedPage() {
  std::ifstream file(HEMITEX_DOCS "/accuracy.md", std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

/// The committed section with the same headline.
std::string committed(const std::string& section) {
  const std::string page = committedPage(), head = section.substr(0, section.find('\n') + 1);
  const std::size_t begin = page.find(head);
  if (begin == std::string::npos) return {};
  const std::size_t end = page.find("\n## ", begin + 1);
  return page.substr(begin, end == std::string::npos ? end : end + 1 - begin);
}

void checkSection(const std::string& section) {
  INFO("write the page again: build/release/bin/hemitex_accuracy docs/accuracy.md");
  CHECK(committed(section) == section);
}

/// Within four standard errors plus the errors that neither samples nor corners show.
bool agrees(const reference::Measurement& measured, const FormFactorCase& extreme) {
  const double unknown = 1e-9 + extreme.inputRounding * extreme.exact + extreme.rim;
  return std::abs(measured.value - extreme.exact) <= 4 * measured.standardError + unknown;
}

/// Hemicubes agree with closed forms from their eye positions, within the pixels along the outline.
bool agrees(const FromCentres& centres) { return std::abs(centres.hemicubes - centres.closedForm) <= centres.aliasing; }

std::vector<FormFactorAnswers> checked(const FormFactorTheme& theme) {
  std::vector<FormFactorAnswers> answers;
  for (const FormFactorCase& extreme : theme.cases) {
    INFO(extreme.name);
    answers.push_back(answersTo(extreme));
    const FormFactorAnswers& answer = answers.back();
    CHECK(agrees(answer.aimed, extreme));
    CHECK(agrees(answer.hemisphere, extreme));
    if (extreme.isBlocked) continue;
    CHECK(std::abs(answer.closedForm - extreme.exact) <= (1e-9 + extreme.inputRounding) * extreme.exact);
    CHECK(agrees(answer.one));
    CHECK(agrees(answer.many));
  }
  checkSection(section(theme, answers));
  return answers;
}

}  // namespace

TEST_CASE("answersTo gaps from 1e-6 to 1e4 sides agree with docs/accuracy.md", "[accuracy]") { checked(gaps()); }

TEST_CASE("answersTo slivers of 1 to 1e-6 agree with docs/accuracy.md", "[accuracy]") { checked(slivers()); }

TEST_CASE("answersTo shared edges and touching corners agree with docs/accuracy.md", "[accuracy]") {
  checked(touching());
}

TEST_CASE("answersTo dihedral angles from 1 to 179 degrees agree with docs/accuracy.md", "[accuracy]") {
  // In a closed prism only its faces are visible.
  for (const FormFactorAnswers& answer : checked(angles())) {
    CHECK(answer.lostByRays == 0);
    CHECK(answer.one.lost == 0);
    CHECK(answer.many.lost == 0);
  }
}

TEST_CASE("answersTo blockers of zero thickness that hide a quarter, a half and all agree with docs/accuracy.md",
          "[accuracy]") {
  // From the middle of a square the sheet ends between the middle columns, or rows, of pixels. So equal numbers of
  // pixels are hidden on one side and visible on the other, and the shares are 3 : 2 : 0.
  const std::vector<FormFactorAnswers> answers = checked(blockers());
  const FormFactorAnswers &quarter = answers[0], &half = answers[1], &all = answers[2];
  CHECK(half.one.hemicubes > 0);
  CHECK(2 * quarter.one.hemicubes == 3 * half.one.hemicubes);
  CHECK(all.one.hemicubes == 0);
  CHECK(all.many.hemicubes == 0);
  CHECK(all.hemisphere.value == 0);
}

TEST_CASE("answersTo coincident and interpenetrating surfaces agree with docs/accuracy.md", "[accuracy]") {
  const std::vector<FormFactorAnswers> answers = checked(coincident());
  for (const std::size_t hidden : {std::size_t{1}, std::size_t{3}}) {
    CHECK(answers[hidden].hemisphere.value == 0);  // aimed rays may give a standard error instead of 0
    CHECK(answers[hidden].one.hemicubes == 0);
    CHECK(answers[hidden].many.hemicubes == 0);
  }
}

TEST_CASE("answersTo scenes scaled by 1e-6 and 1e6, and moved by 1e3, 1e6 and 1e8, agree with docs/accuracy.md",
          "[accuracy]") {
  // Rounding to binary32 rarely changes a pixel. In means of 64 hemicubes, and for rays, only the rounding of the
  // corners remains.
  const std::vector<FormFactorAnswers> answers = checked(scaledAndMoved());
  for (const FormFactorAnswers& answer : answers) {
    CHECK(answer.hemisphere.value == answers[0].hemisphere.value);
    CHECK(answer.many.hemicubes == Approx(answers[0].many.hemicubes).epsilon(1e-5));
  }
}

TEST_CASE("answersTo emitters of 1e-8 of the scene's area agree with docs/accuracy.md", "[accuracy]") {
  checked(smallEmitters());
}

TEST_CASE("findingsOf furnaces with reflectances up to 0.9999 conserve flux", "[accuracy]") {
  std::vector<FurnaceFindings> findings;
  for (const FurnaceCase& furnace : furnaces()) {
    INFO("reflectance " << furnace.reflectance);
    findings.push_back(findingsOf(furnace));
    // Each shot has a relative rounding error of at most 2^-53.
    CHECK(findings.back().meanError <= (findings.back().shots + 8) * 0x1p-53);
    CHECK(findings.back().accountError <= 1e-12);
    CHECK_FALSE(findings.back().grew);
  }
  checkSection(section(furnaces(), findings));
}

TEST_CASE("findingsOf emissions from 1e-30 to 1e30 are linear", "[accuracy]") {
  std::vector<EmissionFindings> findings;
  for (const EmissionCase& emission : emissions()) {
    INFO("emission " << emission.emission);
    findings.push_back(findingsOf(emission));
    // Fewer than 1000 shots, each with a rounding error of 2^-53.
    CHECK(findings.back().linearityError <= 1000 * 0x1p-53);
    CHECK(findings.back().accountError <= 1e-12);
  }
  checkSection(section(emissions(), findings));
}

TEST_CASE("ofOneSurface finds that all light leaves the scene", "[accuracy]") {
  const OneSurfaceFindings findings = ofOneSurface();
  CHECK(findings.backgroundOfHemicube == 1);
  CHECK(findings.backgroundOfRays == 1);
  CHECK(findings.lost == 1);
  checkSection(section(findings));
}

TEST_CASE("ofAMillionSurfaces finds the light of one undivided surface", "[.million]") {
  const MillionFindings findings = ofAMillionSurfaces();
  CHECK(findings.surfaces == 1000000);
  CHECK(findings.isWhole);
  CHECK(findings.hemicubeError <= findings.aliasing);
  CHECK(findings.hemisphereError <= 4 * findings.standardError);
  checkSection(section(findings));
}

TEST_CASE("idCases fill all item IDs for index maps of 1 to 31 bits", "[accuracy]") {
  const std::vector<IdCase> cases = idCases();
  CHECK(cases.size() == 31);
  for (const IdCase& example : cases) {
    INFO(example.indexBits << " bits in " << example.format);
    CHECK(isOneToOne(example));
    CHECK_FALSE(example.refusal.empty());
  }
  checkSection(section(cases));
}

TEST_CASE("SoftwareRenderer draws item IDs of 1 to 31 index bits as layOut assigns them", "[accuracy]") {
  // A wall of two texels, the first and the last index of a block. Tests the last but one block of the item ID, then
  // the last, which ends two item IDs short.
  for (const char* format : {"r8g8b8a8", "r32ui"})
    for (int k = 1; k <= 31; ++k)
      for (const bool isLast : {false, true}) {
        if (isLast && k == 1) continue;  // a block of two, both reserved
        const auto blocks = raster::ItemId{1} << (32 - k);
        const raster::ItemId offset = (blocks - (isLast ? 1 : 2)) << k;
        const raster::ItemId index = (raster::ItemId{1} << k) - (isLast ? 3 : 1);
        raster::DrawList list;
        list.format = *raster::formatNamed(format);
        list.indexMaps = {{2, 1, {0, index}}};
        reference::addDraw(list, offset, {}, 0);
        reference::addQuad(list, {{{-1, -1, 1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, 1}}});
        raster::SoftwareRenderer renderer(list);
        const raster::Face face = reference::frontFace(2);
        const raster::ItemBuffer buffer = render(renderer, {&face, 1}, {}).front();
        INFO(k << " bits in " << format);
        CHECK(buffer.ids == std::vector<raster::ItemId>{offset, offset + index, offset, offset + index});
      }
}

TEST_CASE("limitCases give the messages of docs/accuracy.md", "[accuracy]") {
  for (const LimitCase& example : limitCases()) {
    INFO(example.name);
    CHECK_FALSE(example.message.empty());
  }
  checkSection(section(limitCases()));
}

TEST_CASE("docs/accuracy.md has the introduction and all sections in order", "[accuracy]") {
  std::istringstream page(committedPage());
  std::string headlines, expected;
  for (std::string line; std::getline(page, line);)
    if (line.starts_with("## ")) headlines += line + "\n";
  for (const Section& section : sections()) expected += headline(section.title);
  CHECK(headlines == expected);
  checkSection(errorBoundSection());
  CHECK(committedPage().starts_with(introduction() + headline(sections().front().title)));
}
