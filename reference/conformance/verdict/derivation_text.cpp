#include "reference/conformance/verdict/derivation_text.h"

#include <map>
#include <nlohmann/json.hpp>

#include "raster/base/short_number.h"
#include "reference/conformance/verdict/explanation.h"

namespace hemitex::reference {
namespace {

using Json = nlohmann::ordered_json;

/// Where the values of a key come from.
const std::map<std::string, std::string> formulas{
    {"vertices", "d = P - eye; x = X.d, y = Y.d, w = W.d in binary32"},
    {"clip", "to w >= n and |x|, |y| <= 8w"},
    {"corners", "q = (x/w, y/w), clamped to [-8, 8]; snapped = nearbyint((q + 1) 128 R)"},
    {"sample", "in 1/256 pixel"},
    {"area", "doubled"},
    {"faces_away", "area and det(X, Y, W) have the same sign"},
    {"edges", "opposite the corners; inside > 0, and = 0 on top and left edges"},
    {"weights", "b = edge / |area|"},
    {"inverse_depth", "sum of b/w"},
    {"u", "sum of b u/w over 1/w"},
    {"v", "sum of b v/w over 1/w"},
    {"texel", "floor of position = (u N, v M), clamped to the map"},
    {"sums", "offset + texel, clamped or modulo 2^bits"},
    {"word", "the item ID"},
    {"depth", "as it is stored; else sum of b z/w"},
    {"runner_up", "the next triangle; difference of 1/w"}};

std::string inLine(const Json& value) {
  if (value.is_null()) return "none";
  if (value.is_string()) return value.get<std::string>();
  if (value.is_number_float()) {
    // A binary32 is written as such: 0.1, not 0.10000000149011612.
    const auto wide = value.get<double>();
    const auto narrow = static_cast<float>(wide);
    return static_cast<double>(narrow) == wide ? raster::toText(narrow) : raster::toText(wide);
  }
  if (!value.is_structured()) return value.dump();
  std::string text;
  for (const auto& [key, entry] : value.items())
    text += (text.empty() ? "" : ", ") + (value.is_object() ? key + " " : "") + inLine(entry);
  return value.is_object() ? text : "(" + text + ")";
}

/// A line per key, with the formula of its values; lists of objects take a line per entry.
std::string toLines(const Json& steps) {
  std::string lines;
  for (const auto& [key, value] : steps.items()) {
    const auto formula = formulas.find(key);
    lines += key + (formula == formulas.end() ? "" : " (" + formula->second + ")") + ":";
    const bool isList = value.is_array() && !value.empty() && value[0].is_object();
    if (isList)
      for (const Json& entry : value) lines += "\n  " + inLine(entry);
    else
      lines += " " + inLine(value);
    lines += "\n";
  }
  return lines;
}

}  // namespace

std::string derivationText(const Json& explanation, const raster::Face& face) {
  const std::string pixel = "pixel " + inLine(explanation["column"]) + ',' + inLine(explanation["row"]) + " of " +
                            inLine(explanation["face"]) + " holds " + inLine(explanation["word"]) + ": " +
                            inLine(explanation["from"]) + '\n';
  const Json& derivation = explanation["derivation"];
  return derivation.is_null() ? pixel : pixel + toLines({{"face", viewOf(face)}}) + toLines(derivation);
}

}  // namespace hemitex::reference
