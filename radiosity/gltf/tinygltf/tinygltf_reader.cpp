/// The module hemitex_gltf: reads glTF by tinygltf. tinygltf parses the file; this code checks every index, range
/// and number that it returns.
#include <tiny_gltf.h>

#include <algorithm>
#include <array>
#include <boost/algorithm/string/replace.hpp>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "radiosity/gltf/gltf_module.h"
#include "radiosity/gltf/tinygltf/accessors.h"
#include "radiosity/gltf/tinygltf/model_parts.h"
#include "raster/base/input_error.h"

namespace hemitex::radiosity {
namespace {

/// The folder of the scene, and the files in it that were read.
struct SceneFolder {
  const std::string& name;
  const ImportBudget& budget;
  std::vector<std::string>& read;
  std::set<std::string> images = {};  ///< whose bytes are kept
  std::string asked = {};             ///< the last file that was looked for
};

/// Keeps the bytes of an image from a file, once per file, or a data URI. Those of buffer views are read later, after a
/// check of their range, which tinygltf omits.
bool keepImage(tinygltf::Image* image, int, std::string*, std::string*, int, int, const unsigned char* bytes, int size,
               void* folder) {
  if (image->bufferView >= 0) return true;
  if (image->uri.empty() || static_cast<SceneFolder*>(folder)->images.insert(image->uri).second)
    image->image.assign(bytes, bytes + size);
  return true;
}

/// Whether a name leads to a file in the folder of the scene or below it.
bool isInside(const std::string& name, const std::string& folder) {
  if (!name.starts_with(folder + "/")) return false;
  const std::filesystem::path rest = std::filesystem::path(name.substr(folder.size() + 1)).lexically_normal();
  return rest.is_relative() && rest != "." && (rest.empty() || *rest.begin() != "..");
}

bool fileExists(const std::string& name, void* folder) {
  std::error_code ignored;
  auto* const scene = static_cast<SceneFolder*>(folder);
  scene->asked = name;
  return isInside(name, scene->name) && std::filesystem::is_regular_file(name, ignored);
}

bool readWholeFile(std::vector<unsigned char>* bytes, std::string* problem, const std::string& name, void* folder) {
  auto& [ignored, budget, read, images, asked] = *static_cast<SceneFolder*>(folder);
  std::error_code unknown;
  const std::uintmax_t size = std::filesystem::file_size(name, unknown);
  budget.forFile(unknown ? 0 : size, name);
  read.push_back(name);
  std::ifstream file(name, std::ios::binary);
  bytes->assign(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
  if (!file.eof() && !file) *problem = "it cannot be read";
  return problem->empty();
}

/// tinygltf expands names as a shell does; names in a scene are names.
std::string sameName(const std::string& name, void*) { return name; }

/// The fault of a file, from tinygltf's message.
Fault faultOf(const std::string& message, const SceneFolder& folder) {
  if (message.starts_with("File not found")) {
    const std::string name = std::filesystem::path(folder.asked).filename().string();
    return {"names the file `" + name + "`, which is not in its folder or below", "put it there"};
  }
  const std::size_t place = message.find("line ");
  if (message.starts_with("[json.") && place != std::string::npos)
    return {"is not JSON: " + message.substr(place, message.find(':', place) - place), exportAgain};
  return {"is no valid glTF", "give a glTF 2.0 file"};
}

/// What tinygltf can read in place of a file; nothing if that is the file. It knows no data URI of a WebP image, but
/// does not look at the bytes either, so that another type of equal length does.
std::optional<std::string> readableBytes(const std::string& bytes) {
  const std::string webp = "data:image/webp;base64,";
  std::optional<std::string> edited = withPlaceholders(bytes);
  if (bytes.find(webp) != bytes.npos)
    edited = boost::replace_all_copy(edited ? *edited : bytes, webp, "data:image/jpeg;base64,");
  return edited;
}

}  // namespace

tinygltf::Model parsed(const std::string& given, const std::string& name, const ImportBudget& budget,
                       std::vector<std::string>& files) {
  SceneFolder folder{name, budget, files};
  if (given.size() > std::numeric_limits<unsigned int>::max())
    throw Fault{"the file has more than 4 GiB", "divide the scene"};
  const std::optional<std::string> edited = readableBytes(given);
  const std::string& bytes = edited ? *edited : given;
  tinygltf::TinyGLTF reader;
  reader.SetImageLoader(keepImage, &folder);
  reader.SetFsCallbacks({fileExists, sameName, readWholeFile, nullptr, &folder});
  tinygltf::Model gltf;
  std::string error, warning;  // it warns of missing images, which have no bytes
  const auto size = static_cast<unsigned int>(bytes.size());
  const bool isRead =
      bytes.starts_with("glTF")
          ? reader.LoadBinaryFromMemory(&gltf, &error, &warning, reinterpret_cast<const unsigned char*>(bytes.data()),
                                        size, folder.name)
          : reader.LoadASCIIFromString(&gltf, &error, &warning, bytes.data(), size, folder.name);
  if (!isRead || !error.empty()) throw faultOf(error, folder);
  return gltf;
}

namespace {

/// The extensions that are read, or named in a warning of their own.
constexpr std::array<std::string_view, 11> extensionsRead{
    "KHR_mesh_quantization",   "KHR_texture_transform",     "KHR_materials_emissive_strength",
    "EXT_mesh_gpu_instancing", "EXT_texture_webp",          "KHR_materials_pbrSpecularGlossiness",
    "KHR_lights_punctual",     "KHR_materials_unlit",       "KHR_materials_transmission",
    "EXT_meshopt_compression", "KHR_draco_mesh_compression"};

bool isRead(const std::string& extension) {
  return std::find(extensionsRead.begin(), extensionsRead.end(), extension) != extensionsRead.end();
}

/// Throws Fault for an extension without which the file cannot be understood.
void checkExtensions(const tinygltf::Model& gltf) {
  for (const std::string& name : gltf.extensionsRequired)
    if (!isRead(name))
      throw Fault{"needs the extension " + name + ", which is not read", "export without this extension"};
}

void warnOfOmissions(const tinygltf::Model& gltf, GltfImport& import) {
  if (!gltf.skins.empty() || !gltf.animations.empty()) import.warnings.push_back("skins and animations are left out");
  std::string others;
  for (const std::string& name : gltf.extensionsUsed) {
    if (name == "KHR_materials_unlit")
      import.warnings.push_back("unlit materials are read as lit ones; their base colour is the reflectance");
    if (!isRead(name)) others += (others.empty() ? "" : ", ") + name;
  }
  if (!others.empty()) import.warnings.push_back("extensions that are not read are left out: " + others);
}

ImportProblem read(const std::string& bytes, const std::string& folder, const ImportBudget& budget,
                   GltfImport& import) {
  try {
    tinygltf::Model gltf = parsed(bytes, folder, budget, import.files);
    checkExtensions(gltf);
    decompress(gltf, budget);
    warnOfOmissions(gltf, import);
    readMaterials(gltf, import);
    readNodes(gltf, budget, import);
  } catch (const Fault& fault) {
    return fault;
  } catch (const raster::InputError&) {  // of the budget
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception&) {  // of tinygltf's JSON parser
    return {"is no valid glTF", exportAgain};
  }
  return {};
}

}  // namespace
}  // namespace hemitex::radiosity

extern "C" __attribute__((visibility("default")))
const hemitex::radiosity::GltfReader hemitexGltfReader = {hemitex::radiosity::read};
