// makeOpenGlRenderer on a real device: verdicts on both of its paths, and a scene that it lights. Without a device,
// each test reports that it was skipped.
#include "reference/devices/opengl/opengl_renderer.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <set>

#include "radiosity/discretization/discretize.h"
#include "radiosity/form_factors/projected_form_factors.h"
#include "radiosity/index_maps/scene_draw_list.h"
#include "radiosity/scene/load_scene.h"
#include "radiosity/solver/progressive_solver.h"
#include "raster/base/input_error.h"
#include "reference/conformance/calibration/calibration.h"
#include "reference/conformance/scenes/scene_vectors.h"
#include "reference/conformance/vectors/random_vectors.h"
#include "reference/conformance/vectors/vector_file.h"
#include "reference/conformance/verdict/verdict.h"
#include "reference/devices/opengl/context.h"
#include "tests/support/device_scenes.h"

using namespace hemitex;
using reference::makeOpenGlRenderer;
using reference::OpenGlPath;
using reference::PixelVerdict;
using reference::TestVector;

namespace {

bool hasDevice() {
  const bool isFound = reference::OpenGlContext::create() != nullptr;
  if (!isFound) {
    CHECK_THROWS_AS(makeOpenGlRenderer(tests::plainList(), OpenGlPath::Shader), raster::InputError);
    WARN("skipped: no OpenGL device answers through EGL");
  }
  return isFound;
}

/// Whether the shares of exact pixels are known: those of another device depend on its interpolation and its depths.
bool isLlvmpipe() { return reference::openGlDeviceName().find("llvmpipe") != std::string::npos; }

/// |b - truth| over truth of each element; infinite if only the truth is dark.
std::vector<double> errorsByElement(std::span<const glm::dvec3> found, std::span<const glm::dvec3> truth) {
  std::vector<double> errors;
  for (std::size_t e = 0; e < found.size(); ++e) {
    const double error = radiosity::bandSum(glm::abs(found[e] - truth[e]));
    errors.push_back(error == 0 ? 0 : error / radiosity::bandSum(truth[e]));
  }
  return errors;
}

/// The number of pixels of the vector "depth-steps" that a depth buffer of n/w in binary32 can show exactly. The two
/// triangles of pixel p have the depths w = (1 + (p mod 16)/16) 2^(p/16) and the next binary32 number; for even p the
/// nearer one comes first. In the upper half of [1, 2) binary32 numbers are denser than their inverses, which n, a
/// power of two, only scales. If two inverses round to one number, the first triangle wins, right or wrong.
std::uint64_t depthStepsInBinary32() {
  std::uint64_t right = 0;
  for (int p = 0; p < 256; ++p) {
    const float w = std::ldexp(1.0f + static_cast<float>(p % 16) / 16, p / 16);
    right += p % 2 == 0 || 1 / w != 1 / std::nextafter(w, 1e9f);
  }
  return right;
}

/// None if the path does not draw the list.
std::unique_ptr<raster::ItemBufferRenderer> rendererIfDrawn(const raster::DrawList& list, OpenGlPath path) {
  try {
    return makeOpenGlRenderer(list, path);
  } catch (const raster::InputError&) {
    return nullptr;
  }
}

/// Draws the suite and judges it with the default profile, which has 8 bits of sub-pixel precision and depths in
/// binary32, as graphics cards and Mesa's llvmpipe have. Returns the names of the vectors that the path does not draw.
std::vector<std::string> judgeSuite(OpenGlPath path) {
  const bool areSharesKnown = isLlvmpipe();
  tests::Tally suite;
  std::vector<std::string> leftOut;
  for (const TestVector& vector : reference::wholeSuite(HEMITEX_DATA)) {
    INFO(vector.name);
    const auto renderer = rendererIfDrawn(vector.list, path);
    if (!renderer) {
      leftOut.push_back(vector.name);
      continue;
    }
    const reference::Verdict verdict = judge(vector, render(*renderer, facesOf(vector), {}), {});
    CHECK(!hasErrors(verdict));
    const tests::Tally tally = tests::tallyOf(vector, verdict);
    if (vector.name == "depth-steps" && path == OpenGlPath::FixedFunction) {
      CHECK((!areSharesKnown || tally.exact >= depthStepsInBinary32()));
    } else if (areSharesKnown) {
      CHECK(static_cast<double>(tally.exact) >= 0.99 * static_cast<double>(tally.covered));
    }
    suite += tally;
  }
  CHECK(suite.covered > 200000);
  CHECK(static_cast<double>(suite.exact) >= (areSharesKnown ? 0.999 : 0.98) * static_cast<double>(suite.covered));
  return leftOut;
}

/// The paths with remedies.
constexpr std::array<OpenGlPath, 2> paths{OpenGlPath::FixedFunction, OpenGlPath::Shader};

/// Draws on the device, judges each item buffer, and collects the item IDs of explained pixels.
class JudgedRenderer final : public raster::ItemBufferRenderer {
 public:
  JudgedRenderer(const raster::DrawList& list, OpenGlPath path)
      : list_(list), device_(makeOpenGlRenderer(list, path)) {}

  void draw(std::span<const raster::Face> faces, std::span<const std::uint32_t> skipped,
            std::vector<raster::ItemBuffer>& buffers, const std::function<void(std::size_t)>& drawn) override {
    TestVector vector;
    vector.list = tests::without(list_, skipped);
    for (const raster::Face& face : faces) vector.faces.push_back({"", face, "", ""});
    device_->draw(faces, skipped, buffers, drawn);
    const reference::Verdict verdict = judge(vector, buffers, {});
    CHECK(!hasErrors(verdict));
    for (const reference::FaceVerdict& face : verdict.faces)
      for (std::size_t p = 0; p < face.pixels.size(); ++p)
        if (face.pixels[p] != PixelVerdict::Exact) explained.insert({face.expected.ids[p], face.found.ids[p]});
  }

  std::set<raster::ItemId> explained;  ///< item IDs of the rules and of the device

 private:
  raster::DrawList list_;
  std::unique_ptr<raster::ItemBufferRenderer> device_;
};

}  // namespace

TEST_CASE("makeOpenGlRenderer with fixed function draws all vectors of the suite that bytes can add, without errors",
          "[opengl]") {
  if (!hasDevice()) return;
  // Sums with carries between bytes, or with clamping at other bits.
  CHECK(judgeSuite(OpenGlPath::FixedFunction) ==
        std::vector<std::string>{"layout-r5g6b5", "layout-r10g10b10a2", "layout-r32ui", "layout-3-1-7-2",
                                 "integer-add-24", "integer-add-32", "unaligned-integer-add", "edge-texels-added",
                                 "scene-paper-room-tilted"});
}

TEST_CASE("makeOpenGlRenderer with shaders draws the whole suite without errors", "[opengl]") {
  if (!hasDevice()) return;
  CHECK(judgeSuite(OpenGlPath::Shader).empty());
}

TEST_CASE("makeOpenGlRenderer without remedies draws the whole suite without errors, but fewer pixels exactly",
          "[opengl]") {
  if (!hasDevice()) return;
  tests::Tally plain, shader;
  for (const TestVector& vector : reference::wholeSuite(HEMITEX_DATA)) {
    INFO(vector.name);
    const auto verdictOf = [&vector](OpenGlPath path) {
      return judge(vector, render(*makeOpenGlRenderer(vector.list, path), facesOf(vector), {}), {});
    };
    const reference::Verdict verdict = verdictOf(OpenGlPath::Plain);
    CHECK(!hasErrors(verdict));
    plain += tests::tallyOf(vector, verdict);
    shader += tests::tallyOf(vector, verdictOf(OpenGlPath::Shader));
  }
  CHECK(static_cast<double>(plain.exact) >= (isLlvmpipe() ? 0.98 : 0.9) * static_cast<double>(plain.covered));
  CHECK(plain.exact < shader.exact);
}

TEST_CASE("makeOpenGlRenderer draws version 2 of the rules; fixed function draws no holes, and item IDs alone",
          "[opengl]") {
  if (!hasDevice()) return;
  tests::Tally shader;
  int drawn = 0, refused = 0;  // by fixed function
  for (const TestVector& vector : tests::version2Vectors(30))
    for (const OpenGlPath path : {OpenGlPath::FixedFunction, OpenGlPath::Shader, OpenGlPath::Plain}) {
      INFO(vector.name << ", path " << static_cast<int>(path));
      // At equal depths of different triangles the rounding of the device decides, and counts have no tolerance.
      if (path == OpenGlPath::Plain && vector.list.value == raster::PixelValue::PassedSamples) continue;
      const auto renderer = rendererIfDrawn(vector.list, path);
      const bool isFixed = path == OpenGlPath::FixedFunction;
      if (isFixed) ++(renderer ? drawn : refused);
      const std::vector<raster::IndexMap>& maps = vector.list.indexMaps;
      const bool isSimple =
          vector.list.value == raster::PixelValue::ItemIds && std::none_of(maps.begin(), maps.end(), raster::hasHoles);
      // Bytes cannot add the sums of some assemblies.
      const bool mayRefuse = isFixed && (!isSimple || vector.name.starts_with("assemblies-"));
      CHECK((renderer ? !isFixed || isSimple : mayRefuse));
      if (!renderer) continue;
      reference::DeviceProfile profile;
      if (path == OpenGlPath::Plain) profile.texelPrecision = 0x1p-6;  // binary32, also at corners that clipping adds
      const reference::Verdict verdict = judge(vector, render(*renderer, facesOf(vector), {}), profile);
      CHECK(!hasErrors(verdict));
      if (path == OpenGlPath::Shader) shader += tests::tallyOf(vector, verdict);
    }
  CHECK(drawn > 40);
  CHECK(refused > 40);
  CHECK(shader.covered > 10000);
  CHECK(static_cast<double>(shader.exact) >= 0.99 * static_cast<double>(shader.covered));
}

TEST_CASE("makeOpenGlRenderer assembles strips, instances and pairs itself", "[opengl]") {
  if (!hasDevice()) return;
  for (const TestVector& vector : reference::drawVectors())
    for (const OpenGlPath path : {OpenGlPath::Shader, OpenGlPath::Plain}) {
      INFO(vector.name);
      const auto whole = render(*makeOpenGlRenderer(sourceOf(vector), path), facesOf(vector), {});
      CHECK(whole.front().ids == render(*makeOpenGlRenderer(vector.list, path), facesOf(vector), {}).front().ids);
    }
}

TEST_CASE("makeOpenGlRenderer answers all probes, and its pixels are no errors under the profile that calibrate finds",
          "[opengl]") {
  if (!hasDevice()) return;
  const reference::ProbingSet probes = reference::makeProbes();
  for (const OpenGlPath path : {OpenGlPath::FixedFunction, OpenGlPath::Shader, OpenGlPath::Plain}) {
    INFO("path " << static_cast<int>(path));
    const auto drawn = [path](const TestVector& vector) {
      return render(*makeOpenGlRenderer(vector.list, path), facesOf(vector), {});
    };
    std::vector<raster::ItemBuffer> answers;
    for (const TestVector& probe : vectorsOf(probes)) answers.push_back(drawn(probe).front());
    const reference::Calibration calibration = calibrate(probes, answers);
    CHECK(calibration.faults.empty());
    CHECK(calibration.profile.edgeRule == reference::EdgeRule::TopLeft);
    for (const char* name : {"five-faces", "perspective-floor", "many-maps", "depth-stack", "sub-pixel-sheet"}) {
      INFO(name);
      const TestVector vector = tests::suiteVector(name);
      CHECK(!hasErrors(judge(vector, drawn(vector), calibration.profile)));
    }
  }
}

TEST_CASE("makeOpenGlRenderer draws with the device of a name, and with no other", "[opengl]") {
  if (!hasDevice()) return;
  const std::string name = reference::openGlDeviceName();
  CHECK_FALSE(name.empty());
  CHECK(reference::openGlDeviceName(name.substr(1, 5)) == name);
  CHECK_NOTHROW(makeOpenGlRenderer(tests::plainList(), OpenGlPath::Shader, name));
  CHECK_THROWS_WITH(makeOpenGlRenderer(tests::plainList(), OpenGlPath::Shader, "abacus"),
                    Catch::Contains("no OpenGL device with \"abacus\" in its name"));
}

TEST_CASE("makeOpenGlRenderer leaves out skipped triangles", "[opengl]") {
  if (!hasDevice()) return;
  TestVector vector = tests::suiteVector("five-faces");
  const raster::DrawList whole = vector.list;
  std::vector<std::uint32_t> all(whole.indices.size() / 3);
  for (std::uint32_t t = 0; t < all.size(); ++t) all[t] = t;
  for (const OpenGlPath path : {OpenGlPath::FixedFunction, OpenGlPath::Shader, OpenGlPath::Plain}) {
    const auto renderer = makeOpenGlRenderer(whole, path);
    for (const std::vector<std::uint32_t>& skipped : {{}, {0}, {1, 2, 7}, {3, 4, 5, 11}, all}) {
      vector.list = tests::without(whole, skipped);
      CHECK(!hasErrors(judge(vector, render(*renderer, facesOf(vector), skipped), {})));
    }
  }
}

TEST_CASE("makeOpenGlRenderer draws faces of many sizes like a new renderer per face", "[opengl]") {
  if (!hasDevice()) return;
  const raster::DrawList list = tests::suiteVector("five-faces").list;
  std::vector<raster::Face> faces;
  for (int size = 1; size <= 20; ++size) {
    faces.push_back(tests::frontFace(32));
    faces.back().scissor = {3, 2, size, 21 - size};
  }
  faces.push_back(faces.front());
  for (const OpenGlPath path : {OpenGlPath::Shader, OpenGlPath::Plain}) {
    const std::vector<raster::ItemBuffer> buffers = render(*makeOpenGlRenderer(list, path), faces, {});
    for (std::size_t f = 0; f < faces.size(); ++f)
      CHECK(buffers[f].ids == render(*makeOpenGlRenderer(list, path), {&faces[f], 1}, {}).front().ids);
  }
}

TEST_CASE("makeOpenGlRenderer drops triangles with a value that is not finite", "[opengl]") {
  if (!hasDevice()) return;
  const raster::DrawList list = tests::wallsWithoutFiniteValues();
  const raster::Face face = tests::scaledFrontFace();
  const std::vector<raster::ItemId> expected = tests::drawOne(list, face).ids;
  CHECK(*std::min_element(expected.begin(), expected.end()) >> 8 == list.draws.size() - 1);
  for (const OpenGlPath path : paths)
    CHECK(render(*makeOpenGlRenderer(list, path), {&face, 1}, {}).front().ids == expected);
}

TEST_CASE("makeOpenGlRenderer throws InputError for lists that the device cannot draw", "[opengl]") {
  if (!hasDevice()) return;
  const auto refusal = [](const raster::DrawList& list, OpenGlPath path) -> std::string {
    try {
      makeOpenGlRenderer(list, path);
      return "";
    } catch (const raster::InputError& error) {
      return error.what();
    }
  };
  raster::DrawList list = tests::plainList();
  list.indexMaps.push_back({2, 1, {0, 1}});
  tests::addDraw(list, 2, {}, 0);
  CHECK(refusal(list, OpenGlPath::FixedFunction).empty());
  list.draws[0].offset = 1;
  CHECK(refusal(list, OpenGlPath::FixedFunction).find("cannot add item IDs of these channels") != std::string::npos);
  CHECK(refusal(list, OpenGlPath::Shader).empty());

  // Larger than any texture today.
  constexpr int width = 1 << 20;
  list.indexMaps[0] = {width, 1, std::vector<raster::ItemId>(width)};
  CHECK(refusal(list, OpenGlPath::Plain).find("index map 0 is larger") != std::string::npos);
  list.draws[0].indexMap = 1;
  CHECK(refusal(list, OpenGlPath::Shader).find("an index map that does not exist") != std::string::npos);

  const auto renderer = makeOpenGlRenderer(tests::plainList(), OpenGlPath::Shader);
  const raster::Face odd = tests::frontFace(15);
  CHECK_THROWS_AS(render(*renderer, {&odd, 1}, {}), raster::InputError);
}

TEST_CASE(
    "makeOpenGlRenderer lights the Cornell box like SoftwareRenderer, except in explained pixels, to a thousandth",
    "[opengl]") {
  if (!hasDevice()) return;
  const radiosity::Scene scene = radiosity::loadScene(std::string(HEMITEX_DATA) + "/cornell-box.obj");
  const radiosity::Discretization discretization = radiosity::discretize(scene, {.texels = 8, .patch = 4});
  const radiosity::IdLayout layout = radiosity::layOut(discretization);
  const raster::DrawList list = radiosity::makeDrawList(scene, discretization, layout);
  const auto solutionOf = [&](raster::ItemBufferRenderer& renderer) {
    radiosity::ProjectedFormFactors rows(scene, discretization, layout, renderer, {.resolution = 128});
    return radiosity::solve({.scene = scene,
                             .discretization = discretization,
                             .patches = discretization.patches,
                             .rowOf = [&rows](const radiosity::Patch& patch) { return rows.ofPatch(patch); },
                             .settings = {.residual = 0.01}});
  };
  raster::SoftwareRenderer software(list);
  const radiosity::Solution expected = solutionOf(software);
  for (const OpenGlPath path : paths) {
    JudgedRenderer device(list, path);
    const radiosity::Solution found = solutionOf(device);
    CHECK(found.shots == expected.shots);
    // An explained pixel moves flux from one element to another; the other elements receive only its reflection.
    std::set<std::uint32_t> touched;
    for (const raster::ItemId id : device.explained)
      if (const auto element = elementOf(discretization, layout, id)) touched.insert(*element);
    const std::vector<double> errors = errorsByElement(found.radiosity, expected.radiosity);
    double largest = 0;
    for (std::uint32_t element = 0; element < errors.size(); ++element)
      if (touched.count(element) == 0) largest = std::max(largest, errors[element]);
    CHECK(largest <= 0.001);
    CHECK(touched.size() <= errors.size() / 10);
  }
}
