#include "data/generate/model.h"

#include <array>
#include <charconv>
#include <map>

namespace hemitex::data {
namespace {

/// The shortest decimal form that parses to the same number, never in scientific notation; -0 becomes 0.
std::string number(double value) {
  std::array<char, 400> digits;
  const auto [end, error] =
      std::to_chars(digits.data(), digits.data() + digits.size(), value + 0.0, std::chars_format::fixed);
  return {digits.data(), end};
}

template <glm::length_t Length>
std::string numbers(const glm::vec<Length, double>& vector, const std::string& separator) {
  std::string text = number(vector[0]);
  for (glm::length_t i = 1; i < Length; ++i) text += separator + number(vector[i]);
  return text;
}

/// The lines of an OBJ statement (`v` or `vt`), one per distinct vector, in the order of first use.
template <glm::length_t Length>
class Numbered {
 public:
  explicit Numbered(std::string statement) : statement_(std::move(statement)) {}

  /// The vector's number, counted from 1 as in OBJ.
  std::size_t operator()(const glm::vec<Length, double>& vector) {
    const std::string line = statement_ + ' ' + numbers(vector, " ") + '\n';
    const auto [entry, isNew] = numberOf_.try_emplace(line, numberOf_.size() + 1);
    if (isNew) lines_ += line;
    return entry->second;
  }

  const std::string& lines() const { return lines_; }

 private:
  std::string statement_;
  std::map<std::string, std::size_t> numberOf_;
  std::string lines_;
};

std::string comments(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += "# " + line + '\n';
  return text;
}

std::string objText(const Model& model) {
  Numbered<3> position("v");
  Numbered<2> texcoord("vt");
  std::string groups;
  for (const Group& group : model.groups) {
    groups += "\ng " + group.name + "\nusemtl " + group.material + '\n';
    for (const Polygon& polygon : group.polygons) {
      groups += 'f';
      for (std::size_t i = 0; i < polygon.corners.size(); ++i) {
        groups += ' ' + std::to_string(position(polygon.corners[i]));
        if (!polygon.texcoords.empty()) groups += '/' + std::to_string(texcoord(polygon.texcoords[i]));
      }
      groups += '\n';
    }
  }
  return comments(model.about) + "\nmtllib " + model.name + ".mtl\n\n" + position.lines() + texcoord.lines() + groups;
}

std::string mtlText(const Model& model) {
  std::string text = comments(model.aboutMaterials);
  for (const Material& material : model.materials) {
    text += "\nnewmtl " + material.name + "\nKd " + numbers(material.reflectance, " ") + '\n';
    if (material.emission != glm::dvec3{0.0}) text += "Ke " + numbers(material.emission, " ") + '\n';
  }
  return text;
}

std::string viewText(const View& view) {
  return "{\n  \"eye\": [" + numbers(view.eye, ", ") + "],\n  \"look_at\": [" + numbers(view.lookAt, ", ") +
         "],\n  \"up\": [" + numbers(view.up, ", ") + "],\n  \"fov\": " + number(view.fov) + "\n}\n";
}

}  // namespace

std::vector<File> files(const Model& model) {
  return {{model.name + ".obj", objText(model)},
          {model.name + ".mtl", mtlText(model)},
          {model.name + ".view.json", viewText(model.view)}};
}

}  // namespace hemitex::data
