#include "cli/solve/edits_file.h"

#include <map>
#include <set>
#include <string>
#include <utility>

#include "radiosity/base/name_suggestions.h"
#include "raster/base/file_io.h"
#include "raster/base/input_error.h"
#include "reference/base/json_text.h"

namespace hemitex::cli {
namespace {

using json = nlohmann::ordered_json;
using radiosity::Edit;
using raster::InputError;

const std::string form =
    "write {\"frames\": [[{\"move\": NAME, \"by\": [x,y,z]}, ...], ...]}; the edits are move, remove, restore, add, "
    "emission and reflectance";

/// The second key of an edit, which holds its argument; empty if the edit has none.
struct EditForm {
  std::string argument = {};
  bool isRequired = false;
};
const std::map<std::string, EditForm>& editForms() {
  static const std::map<std::string, EditForm> forms = {{"move", {"by", true}},     {"remove", {"", false}},
                                                        {"restore", {"", false}},   {"add", {"by", false}},
                                                        {"emission", {"to", true}}, {"reflectance", {"to", true}}};
  return forms;
}

/// The kind of an edit, which is one of its keys. Throws InputError for an unknown kind and for wrong keys.
std::string kindOf(const json& object) {
  if (!object.is_object() || object.empty())
    throw InputError("an edit is not a JSON object with keys: " + reference::shortText(object), form);
  std::string kind;
  for (const auto& [key, value] : object.items())
    if (editForms().contains(key))
      kind = kind.empty()
                 ? key
                 : throw InputError("an edit is two edits at once; write two objects: " + reference::shortText(object),
                                    form);
  const EditForm found = kind.empty() ? EditForm() : editForms().at(kind);
  std::set<std::string> known;
  for (const auto& [name, some] : editForms()) known.insert({name, some.argument});
  known.erase("");
  for (const auto& [key, value] : object.items())
    if (key.empty() || (key != kind && key != found.argument))
      throw InputError("`" + key + "` is no key of " + (kind.empty() ? "an edit" : "`" + kind + "`"),
                       "similar keys: " + radiosity::nearestNames(known, key));
  if (found.isRequired && !object.contains(found.argument))
    throw InputError("`" + kind + "` has no `" + found.argument + "`", form);
  return kind;
}

glm::dvec3 vectorOf(const json& object, const std::string& key) {
  if (!object.contains(key)) return glm::dvec3(0);
  return reference::vectorAt(object, key);
}

/// A name, or those of a list.
std::vector<std::string> namesOf(const json& value) {
  std::vector<std::string> names;
  for (const json& name : value.is_array() ? value : json::array({value})) {
    if (!name.is_string()) throw InputError("an object is named " + reference::shortText(name), form);
    names.push_back(name.get<std::string>());
  }
  return names;
}

/// Appends the edits of an object, one per name.
void appendEdits(const json& object, const std::filesystem::path& folder, const radiosity::SceneSettings& settings,
                 std::vector<Edit>& edits) {
  const std::string kind = kindOf(object);
  for (const std::string& name : namesOf(object.at(kind))) {
    if (kind == "move") edits.push_back(radiosity::Move{name, vectorOf(object, "by")});
    if (kind == "remove") edits.push_back(radiosity::Remove{name});
    if (kind == "restore") edits.push_back(radiosity::Restore{name});
    if (kind == "add") edits.push_back(radiosity::Add{folder / name, settings, vectorOf(object, "by")});
    if (kind == "emission")
      edits.push_back(
          radiosity::SetEmission{name, vectorOf(object, "to"), radiosity::radiosityPerUnit(settings.emission)});
    if (kind == "reflectance") edits.push_back(radiosity::SetReflectance{name, vectorOf(object, "to")});
  }
}

json framesOf(const std::filesystem::path& file) {
  const json content = reference::parseJson<json>(raster::readFile(file, "give a JSON file of edits"), file.string());
  if (!content.is_object() || !content.contains("frames") || content.size() != 1 || !content.at("frames").is_array())
    throw InputError(file.string(), 0, "is no list of frames", form);
  return content.at("frames");
}

}  // namespace

std::vector<Frame> readEdits(const std::filesystem::path& file, const radiosity::Scene& scene,
                             const radiosity::SceneSettings& settings) {
  std::vector<Frame> frames;
  std::string where;
  try {
    radiosity::EditedScene state{scene, {}, {}};
    for (const json& frame : framesOf(file)) {
      where = "frame " + std::to_string(frames.size() + 1) + ": ";
      if (!frame.is_array()) throw InputError("the frame is not a list of edits", form);
      std::vector<Edit> edits;
      for (const json& object : frame) appendEdits(object, file.parent_path(), settings, edits);
      state = radiosity::edited(std::move(state.scene), std::move(state.removed), edits);
      frames.push_back({frame, std::move(edits), state.scene.files});
    }
  } catch (const InputError& error) {
    // A message about an added file names that file already.
    if (!error.file().empty()) throw;
    throw InputError(file.string(), 0, where + error.what());
  }
  return frames;
}

void requireSamePlaces(const std::vector<Frame>& frames, const std::filesystem::path& file) {
  for (std::size_t f = 0; f < frames.size(); ++f)
    for (const Edit& edit : frames[f].edits)
      if (!std::holds_alternative<radiosity::SetEmission>(edit) &&
          !std::holds_alternative<radiosity::SetReflectance>(edit))
        throw InputError(file.string(), 0,
                         "frame " + std::to_string(f + 1) + ": --matrix holds the rows of one geometry",
                         "edit emissions and reflectances alone, or omit --matrix");
}

}  // namespace hemitex::cli
