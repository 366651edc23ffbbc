#include "reference/verdict_report.h"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace hemitex::reference {
namespace {

using Json = nlohmann::ordered_json;
using raster::Word;

// --- where words come from ---

/// The texels of an index map, ordered by what they hold; of equal ones the first comes first.
struct TexelIndex {
  std::vector<std::size_t> order;
  const raster::IndexMap* map;

  explicit TexelIndex(const raster::IndexMap& indexMap) : order(indexMap.words.size()), map(&indexMap) {
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return std::pair(map->words[a], a) < std::pair(map->words[b], b); });
  }

  std::optional<Texel> find(Word word) const {
    const auto place = std::lower_bound(order.begin(), order.end(), word,
                                        [&](std::size_t texel, Word value) { return map->words[texel] < value; });
    if (place == order.end() || map->words[*place] != word) return {};
    const auto width = static_cast<std::size_t>(map->width);
    return Texel{static_cast<int>(*place % width), static_cast<int>(*place / width)};
  }
};

/// The texel that gives `word` behind an offset where no channel clamps.
Word texelBehind(const raster::DrawList& list, Word offset, Word word) {
  return list.blend == raster::Blend::Replace ? word : (word - offset) & raster::backgroundWord(list.format);
}

std::optional<WordOrigin> originIn(const raster::DrawList& list, const std::vector<TexelIndex>& maps,
                                   std::uint32_t number, Word word) {
  const raster::Draw& draw = list.draws[number];
  if (draw.back == word) return WordOrigin{WordOrigin::Kind::Back, number, {}};
  if (!draw.indexMap) {
    if (draw.offset != word) return {};
    return WordOrigin{WordOrigin::Kind::Offset, number, {}};
  }
  const Word behind = texelBehind(list, draw.offset, word);
  if (raster::blend(list.format, list.blend, draw.offset, behind) != word) return {};
  const std::optional<Texel> texel = maps[static_cast<std::size_t>(*draw.indexMap)].find(behind);
  if (!texel) return {};
  return WordOrigin{WordOrigin::Kind::Texel, number, *texel};
}

// --- JSON and XML ---

Json toJson(const VerdictCounts& counts) {
  Json json;
  for (std::size_t k = 0; k < pixelVerdicts; ++k) json[nameOf(static_cast<PixelVerdict>(k))] = counts[k];
  return json;
}

Json toJson(const ErrorPixel& error) {
  Json json{{"face", error.face},
            {"column", error.column},
            {"row", error.row},
            {"expected", error.expected},
            {"found", error.found},
            {"expected_from", toText(error.expectedOrigin)},
            {"found_from", toText(error.foundOrigin)},
            {"triangle", nullptr},
            {"texel", nullptr}};
  if (error.visible) {
    json["triangle"] = error.visible->triangle;
    if (error.visible->texel) json["texel"] = {error.visible->texel->column, error.visible->texel->row};
  }
  return json;
}

std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '&')
      result += "&amp;";
    else if (c == '<')
      result += "&lt;";
    else if (c == '>')
      result += "&gt;";
    else if (c == '"')
      result += "&quot;";
    else if (static_cast<unsigned char>(c) < 0x20)  // XML 1.0 has no way to write control characters
      result += ' ';
    else
      result += c;
  }
  return result;
}

// --- pictures ---

constexpr int gap = 4;  // pixels between pictures

/// A colour that differs from word to word: the word's bits, mixed by odd multipliers (any do) and cut in three.
glm::dvec3 falseColour(Word word) {
  std::uint32_t mixed = word * 2654435769u;
  mixed = (mixed ^ (mixed >> 15)) * 2246822519u;
  mixed ^= mixed >> 13;
  const glm::dvec3 bits(mixed & 255, (mixed >> 8) & 255, (mixed >> 16) & 255);
  return 0.1 + 0.9 * bits / 255.0;
}

glm::dvec3 colourOf(PixelVerdict verdict) {
  switch (verdict) {
    case PixelVerdict::Exact:
      return glm::dvec3(0.04);
    case PixelVerdict::Coverage:
      return {0.02, 0.2, 1};
    case PixelVerdict::Texel:
      return {0, 0.6, 0.1};
    case PixelVerdict::Depth:
      return {1, 0.8, 0};
    case PixelVerdict::LooseClipping:
      return {0.5, 0.1, 0.8};
    case PixelVerdict::Error:
      return {1, 0, 0};
  }
  return {};
}

/// Paints the pixels of a face with `colour(pixel)`, its first at (left, top).
template <typename Colour>
void paint(radiosity::Image& picture, const FaceVerdict& face, int left, int top, const Colour& colour) {
  std::size_t pixel = 0;
  for (int row = 0; row < face.scissor.height; ++row) {
    const std::size_t line = static_cast<std::size_t>(top + row) * static_cast<std::size_t>(picture.width);
    for (int column = 0; column < face.scissor.width; ++column)
      picture.pixels[line + static_cast<std::size_t>(left + column)] = colour(pixel++);
  }
}

}  // namespace

WordOrigin originOf(const raster::DrawList& list, Word word) {
  if (word == raster::backgroundWord(list.format)) return {WordOrigin::Kind::Background, 0, {}};
  const std::vector<TexelIndex> maps(list.indexMaps.begin(), list.indexMaps.end());
  for (std::uint32_t draw = 0; draw < list.draws.size(); ++draw)
    if (const auto origin = originIn(list, maps, draw, word)) return *origin;
  return {};
}

std::string toText(const WordOrigin& origin) {
  const std::string draw = "draw " + std::to_string(origin.draw);
  switch (origin.kind) {
    case WordOrigin::Kind::Background:
      return "background";
    case WordOrigin::Kind::Back:
      return "back of " + draw;
    case WordOrigin::Kind::Offset:
      return draw;
    case WordOrigin::Kind::Texel:
      return draw + " texel " + std::to_string(origin.texel.column) + "," + std::to_string(origin.texel.row);
    case WordOrigin::Kind::Unknown:
      break;
  }
  return "no draw";
}

std::string toText(const ErrorPixel& error) {
  std::string text = "pixel " + std::to_string(error.column) + "," + std::to_string(error.row) + ": expected " +
                     std::to_string(error.expected) + " (" + toText(error.expectedOrigin) + "), found " +
                     std::to_string(error.found) + " (" + toText(error.foundOrigin) + ")";
  if (error.visible) text += "; triangle " + std::to_string(error.visible->triangle) + " is visible there";
  return text;
}

std::vector<ErrorPixel> firstErrors(const TestVector& vector, const Verdict& verdict, std::size_t count) {
  std::vector<ErrorPixel> errors;
  for (std::size_t f = 0; f < verdict.faces.size(); ++f) {
    const FaceVerdict& face = verdict.faces[f];
    const auto width = static_cast<std::size_t>(face.scissor.width);
    for (std::size_t pixel = 0; pixel < face.pixels.size() && errors.size() < count; ++pixel) {
      if (face.pixels[pixel] != PixelVerdict::Error) continue;
      const int column = face.scissor.column + static_cast<int>(pixel % width);
      const int row = face.scissor.row + static_cast<int>(pixel / width);
      const Word expected = face.expected.words[pixel], found = face.found.words[pixel];
      ErrorPixel error{
          face.name, column, row, expected, found, originOf(vector.list, expected), originOf(vector.list, found), {}};
      const std::vector<Fragment> fragments = fragmentsAt(vector.list, vector.faces[f].face, column, row);
      if (!fragments.empty()) error.visible = fragments.front();
      errors.push_back(error);
    }
  }
  return errors;
}

std::string toJson(const Verdict& verdict, const std::vector<ErrorPixel>& errors) {
  Json json{{"vector", verdict.vector}, {"pass", !hasErrors(verdict)}, {"pixels", toJson(countVerdicts(verdict))}};
  json["faces"] = Json::array();
  for (const FaceVerdict& face : verdict.faces) {
    Json entry{{"name", face.name}, {"width", face.scissor.width}, {"height", face.scissor.height}};
    entry.update(toJson(countVerdicts(face)));
    json["faces"].push_back(entry);
  }
  json["errors"] = Json::array();
  for (const ErrorPixel& error : errors) json["errors"].push_back(toJson(error));
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

std::string toJUnit(const Verdict& verdict, const std::vector<ErrorPixel>& errors) {
  std::string cases;
  int failures = 0;
  for (const FaceVerdict& face : verdict.faces) {
    const std::uint64_t wrong = countVerdicts(face)[static_cast<std::size_t>(PixelVerdict::Error)];
    cases += "  <testcase classname=\"" + escaped(verdict.vector) + "\" name=\"" + escaped(face.name) + "\"";
    if (wrong == 0) {
      cases += "/>\n";
      continue;
    }
    ++failures;
    cases += ">\n    <failure message=\"" + std::to_string(wrong) + " pixels are errors\">";
    for (const ErrorPixel& error : errors)
      if (error.face == face.name) cases += escaped(toText(error)) + '\n';
    cases += "</failure>\n  </testcase>\n";
  }
  return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuite name=\"" + escaped(verdict.vector) + "\" tests=\"" +
         std::to_string(verdict.faces.size()) + "\" failures=\"" + std::to_string(failures) + "\">\n" + cases +
         "</testsuite>\n";
}

radiosity::Image toPicture(const Verdict& verdict, Word background) {
  int width = 0, height = -gap;
  for (const FaceVerdict& face : verdict.faces) {
    width = std::max(width, 3 * face.scissor.width + 2 * gap);
    height += face.scissor.height + gap;
  }
  radiosity::Image picture{width, height, {}};
  picture.pixels.assign(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), glm::dvec3(1.0));
  const auto colourOfWord = [=](Word word) { return word == background ? glm::dvec3(0.0) : falseColour(word); };
  int top = 0;
  for (const FaceVerdict& face : verdict.faces) {
    const int step = face.scissor.width + gap;
    paint(picture, face, 0, top, [&](std::size_t pixel) { return colourOfWord(face.expected.words[pixel]); });
    paint(picture, face, step, top, [&](std::size_t pixel) { return colourOfWord(face.found.words[pixel]); });
    paint(picture, face, 2 * step, top, [&](std::size_t pixel) { return colourOf(face.pixels[pixel]); });
    top += face.scissor.height + gap;
  }
  return picture;
}

}  // namespace hemitex::reference
