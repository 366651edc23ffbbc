/// Path-traced pictures, and how far pictures of hemitex are from them.
/// `hemitex_traced_picture SCENE.obj TRUTH.exr WIDTH HEIGHT SIDE [SEED]` traces SIDE x SIDE paths per pixel. The
/// camera is that of the scene, else of SCENE.view.json beside it. `hemitex_traced_picture PICTURE.png TRUTH.exr
/// EXPOSURE TWIN.png` writes the truth as a picture with this exposure, and prints the differences.
#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "radiosity/scene/load_scene.h"
#include "tests/truth/traced_picture.h"

using namespace hemitex;

namespace {

radiosity::SceneCamera cameraIn(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw std::invalid_argument("neither the scene has a camera nor is there " + path);
  const auto view = nlohmann::json::parse(file);
  const auto vector = [&](const char* key) {
    const auto value = view.at(key).get<std::array<double, 3>>();
    return glm::dvec3(value[0], value[1], value[2]);
  };
  return {vector("eye"), vector("look_at"), vector("up"), view.at("fov").get<double>()};
}

void trace(const std::vector<std::string>& arguments) {
  const radiosity::Scene scene = radiosity::loadScene(arguments[0], {.sides = radiosity::Sides::TwoOfSheets});
  const radiosity::SceneCamera camera =
      scene.camera ? *scene.camera
                   : cameraIn(std::filesystem::path(arguments[0]).replace_extension(".view.json").string());
  const auto seed = static_cast<std::uint32_t>(arguments.size() > 5 ? std::stoi(arguments[5]) : 0);
  radiosity::writeExr(arguments[1], tests::tracedPicture(scene, camera, std::stoi(arguments[2]),
                                                         std::stoi(arguments[3]), std::stoi(arguments[4]), seed));
}

void compare(const std::vector<std::string>& arguments) {
  const radiosity::Image picture = radiosity::readImage(arguments[0]);
  radiosity::Image truth = radiosity::readImage(arguments[1]);
  if (picture.width != truth.width || picture.height != truth.height)
    throw std::invalid_argument("the pictures have different sizes");
  for (glm::dvec3& pixel : truth.pixels) pixel *= std::stod(arguments[2]);
  radiosity::writePng(arguments[3], truth);
  const tests::PictureDifference difference = tests::differenceOf(picture, truth);
  std::printf("mean difference %.2f %%, of 99 %% of the pixels at most %.2f %%\n", 100 * difference.mean,
              100 * difference.of99Percent);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const std::vector<std::string> arguments(argv + 1, argv + argc);
    if (arguments.size() == 5 || arguments.size() == 6)
      trace(arguments);
    else if (arguments.size() == 4)
      compare(arguments);
    else
      throw std::invalid_argument("four to six arguments are needed");
  } catch (const std::exception& error) {
    std::cerr << "hemitex_traced_picture: " << error.what()
              << "\nusage: hemitex_traced_picture SCENE.obj TRUTH.exr WIDTH HEIGHT SIDE [SEED]"
                 "\n       hemitex_traced_picture PICTURE.png TRUTH.exr EXPOSURE TWIN.png\n";
    return 2;
  }
}
