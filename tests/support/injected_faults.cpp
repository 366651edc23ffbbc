#include "tests/support/injected_faults.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace hemitex::tests {

Buffers drawAll(const SimulatedDevice& device, const reference::TestVector& vector) {
  Buffers buffers;
  for (const reference::VectorFace& face : vector.faces) buffers.push_back(drawOn(device, vector.list, face.face));
  return buffers;
}

namespace {

using raster::ItemBuffer;
using raster::Word;
using reference::TestVector;

/// Wrong stages of the device.
Injection onDevice(const std::string& fault, const std::string& vector,
                   const std::function<void(SimulatedDevice&)>& spoil) {
  return {fault, vector, [=](const TestVector& right, SimulatedDevice device) {
            spoil(device);
            return drawAll(device, right);
          }};
}

/// A wrong input.
Injection onInput(const std::string& fault, const std::string& vector, const std::function<void(TestVector&)>& spoil) {
  return {fault, vector, [=](const TestVector& right, const SimulatedDevice& device) {
            TestVector wrong = right;
            spoil(wrong);
            return drawAll(device, wrong);
          }};
}

/// A wrong answer; `spoil` sees the words of a face and its width.
Injection onWords(const std::string& fault, const std::string& vector,
                  const std::function<void(std::vector<Word>&, std::size_t)>& spoil) {
  return {fault, vector, [=](const TestVector& right, const SimulatedDevice& device) {
            Buffers buffers = drawAll(device, right);
            for (ItemBuffer& buffer : buffers) spoil(buffer.words, static_cast<std::size_t>(buffer.width));
            return buffers;
          }};
}

template <typename Change>
std::function<void(std::vector<Word>&, std::size_t)> everyWord(const Change& change) {
  return [=](std::vector<Word>& words, std::size_t) {
    for (Word& word : words) word = change(word);
  };
}

Word bgra(Word rgba) { return (rgba & 0xff00ff00) | (rgba & 0xff) << 16 | (rgba >> 16 & 0xff); }

/// The bytes of four words or of two, one by one.
template <typename Byte>
Word bytewise(const Byte& byte) {
  return byte(0) | byte(8) << 8 | byte(16) << 16 | byte(24) << 24;
}

Word byteAt(Word word, Word shift) { return word >> shift & 255; }

// --- views and pictures ---

/// The viewport is the scissor rectangle: -1 and 1 are its borders.
Buffers scissorAsViewport(const TestVector& vector, SimulatedDevice device) {
  Buffers buffers;
  for (const reference::VectorFace& drawn : vector.faces) {
    const raster::Face& face = drawn.face;
    const auto placed = [&](double x, double w, int first, int size) {
      const double pixels = first * w + size * (x + w) / 2;  // times w
      return 2 * pixels / face.resolution - w;
    };
    device.vertex = [&](raster::ViewVertex& v) {
      v.x = placed(v.x, v.w, face.scissor.column, face.scissor.width);
      v.y = placed(v.y, v.w, face.scissor.row, face.scissor.height);
    };
    buffers.push_back(drawOn(device, vector.list, face));
  }
  return buffers;
}

/// The scissor rectangles in targets as large as their viewports, of which the first pixels are read.
Buffers firstPixelsOfTargets(const TestVector& vector, const SimulatedDevice& device) {
  Buffers buffers = drawAll(device, vector);
  for (std::size_t f = 0; f < buffers.size(); ++f) {
    const raster::Scissor& scissor = vector.faces[f].face.scissor;
    const int resolution = vector.faces[f].face.resolution;
    std::vector<Word> target(static_cast<std::size_t>(resolution * resolution),
                             raster::backgroundWord(vector.list.format));
    std::vector<Word>& words = buffers[f].words;
    const auto rowOf = [&](int column, int row) { return target.begin() + row * resolution + column; };
    for (int row = 0; row < scissor.height; ++row)
      std::copy_n(words.begin() + row * scissor.width, scissor.width, rowOf(scissor.column, scissor.row + row));
    for (int row = 0; row < scissor.height; ++row)
      std::copy_n(rowOf(0, row), scissor.width, words.begin() + row * scissor.width);
  }
  return buffers;
}

std::vector<Injection> viewInjections() {
  const auto flippedRows = [](TestVector& vector) {
    for (reference::VectorFace& face : vector.faces) face.face.y = -face.face.y;
  };
  return {onDevice("y of the view flipped", "five-faces",
                   [](SimulatedDevice& device) { device.vertex = [](raster::ViewVertex& v) { v.y = -v.y; }; }),
          onInput("y of the view flipped", "scene-cornell-box-light", flippedRows),
          onDevice("x of the view flipped", "scissors",
                   [](SimulatedDevice& device) { device.vertex = [](raster::ViewVertex& v) { v.x = -v.x; }; }),
          onWords("picture upside down", "five-faces",
                  [](std::vector<Word>& words, std::size_t width) {
                    for (std::size_t p = 0; p < words.size() / 2; ++p)
                      std::swap(words[p], words[(words.size() / width - 1 - p / width) * width + p % width]);
                  }),
          onWords("picture mirrored", "scissors",
                  [](std::vector<Word>& words, std::size_t width) {
                    for (std::size_t p = 0; p < words.size(); ++p)
                      if (p % width < width / 2) std::swap(words[p], words[p / width * width + width - 1 - p % width]);
                  }),
          onWords("picture transposed", "five-faces",
                  [](std::vector<Word>& words, std::size_t width) {
                    std::vector<Word> columns;
                    for (std::size_t column = 0; column < width; ++column)
                      for (std::size_t p = column; p < words.size(); p += width) columns.push_back(words[p]);
                    words = columns;
                  }),
          onInput("faces swapped", "five-faces",
                  [](TestVector& vector) { std::swap(vector.faces[2].face, vector.faces[3].face); }),
          onInput("faces turned", "five-faces",
                  [](TestVector& vector) {
                    raster::Face& top = vector.faces[0].face;
                    const glm::vec3 x = top.x;
                    top.x = -top.y;
                    top.y = x;
                  }),
          {"viewport set to the scissor rectangle", "scissors", scissorAsViewport},
          {"viewport set to the scissor rectangle", "five-faces", scissorAsViewport},
          onInput("scissor rectangle read back from the wrong corner", "scissors",
                  [](TestVector& vector) {
                    for (reference::VectorFace& face : vector.faces)
                      face.face.scissor.column = face.face.scissor.row = 0;
                  }),
          {"scissor rectangle read back from the wrong corner", "scissors", firstPixelsOfTargets},
          onInput("a face's own eye ignored", "odd-faces", [](TestVector& vector) {
            for (reference::VectorFace& face : vector.faces) face.face.eye = vector.faces[0].face.eye;
          })};
}

// --- coverage and depth ---

/// Coverage and depth at four samples, the colour once at the centre; bytes averaged.
Buffers multisampled(const TestVector& vector, SimulatedDevice device) {
  std::vector<Buffers> samples;
  for (const glm::dvec2& sixteenths : {glm::dvec2(6, 2), {14, 6}, {2, 10}, {10, 14}}) {
    device.sample = 16.0 * sixteenths;
    samples.push_back(drawAll(device, vector));
  }
  Buffers resolved = samples[0];
  for (std::size_t f = 0; f < resolved.size(); ++f)
    for (std::size_t p = 0; p < resolved[f].words.size(); ++p)
      resolved[f].words[p] = bytewise([&](Word shift) {
        Word sum = 2;  // rounds a half up
        for (const Buffers& sample : samples) sum += byteAt(sample[f].words[p], shift);
        return sum / 4;
      });
  return resolved;
}

void turnTriangles(TestVector& vector) {
  std::vector<std::uint32_t>& indices = vector.list.indices;
  for (std::size_t i = 0; i < indices.size(); i += 3) std::swap(indices[i], indices[i + 1]);
}

/// The second face of the vector is mirrored, and sees triangles turned over.
Buffers turnedInMirror(const TestVector& vector, const SimulatedDevice& device) {
  TestVector turned = vector;
  turnTriangles(turned);
  return {drawOn(device, vector.list, vector.faces[0].face), drawOn(device, turned.list, vector.faces[1].face)};
}

std::vector<Injection> sampleInjections() {
  return {onWords("triangles missing", "five-faces", everyWord([](Word) { return 0xffffffffu; })),
          onInput("front and back exchanged", "backs", turnTriangles),
          {"front and back exchanged", "backs", turnedInMirror},
          onDevice("wrong fill rule", "sample-grid-later-nearer",
                   [](SimulatedDevice& device) { device.bottomRight = true; }),
          onDevice("sample at the pixel corner", "five-faces",
                   [](SimulatedDevice& device) {
                     device.sample = device.shading = {0, 0};
                   }),
          {"multisampling", "five-faces", multisampled},
          onDevice("16-bit depth", "depth-range",
                   [](SimulatedDevice& device) {
                     device.profile.depthFormat = reference::DepthFormat::Unorm16;
                     device.profile.depthTolerance = 0.5;  // rounding alone
                   }),
          onDevice("depth test off", "depth-stack",
                   [](SimulatedDevice& device) { device.passes = [](double, double) { return true; }; }),
          onDevice("depth test reversed", "depth-stack",
                   [](SimulatedDevice& device) { device.passes = std::greater<double>(); })};
}

// --- textures ---

Word texelOf(const raster::IndexMap& map, double column, double row) {
  const double i = std::clamp(std::floor(column), 0.0, map.width - 1.0);
  const double j = std::clamp(std::floor(row), 0.0, map.height - 1.0);
  return map.words[static_cast<std::size_t>(j * map.width + i)];
}

/// The weighted mean of the four texels whose centres surround a position; maps of plain numbers.
Word bilinear(const raster::IndexMap& map, const glm::dvec2& at) {
  double sum = 0;
  for (const double dx : {-0.5, 0.5})
    for (const double dy : {-0.5, 0.5}) {
      const glm::dvec2 centre = glm::floor(at + glm::dvec2(dx, dy)) + 0.5;
      const glm::dvec2 weight = 1.0 - glm::abs(at - centre);
      sum += weight.x * weight.y * texelOf(map, centre.x, centre.y);
    }
  return static_cast<Word>(std::lround(sum));
}

/// A texel for 8 x 8 of a counting map, which is the mean of their numbers: the third level where 7.5 texels make a
/// pixel.
Word thirdLevel(const raster::IndexMap& map, const glm::dvec2& at) {
  const glm::dvec2 first = 8.0 * glm::floor(glm::clamp(at / 8.0, glm::dvec2(0.0), glm::dvec2(14.0)));
  return static_cast<Word>(std::lround((first.y + 3.5) * map.width + first.x + 3.5));
}

std::vector<Injection> textureInjections() {
  const auto fetching = [](const auto& fetch) { return [=](SimulatedDevice& device) { device.fetch = fetch; }; };
  const auto repeated = [](const raster::IndexMap& map, const glm::dvec2& at) {
    const auto wrapped = [](double texel, int size) { return texel - size * std::floor(texel / size); };
    return texelOf(map, wrapped(at.x, map.width), wrapped(at.y, map.height));
  };
  const auto truncated = [](const raster::IndexMap& map, const glm::dvec2& at) {
    const auto cut = [](double texel, int size) { return std::floor(texel / size * 256) / 256 * size; };
    return texelOf(map, cut(at.x, map.width), cut(at.y, map.height));
  };
  const auto cutAtHeight = [](const raster::IndexMap& map, const glm::dvec2& at) {
    const raster::IndexMap cut{map.height, map.width, map.words};
    return texelOf(cut, at.x / map.width * cut.width, at.y / map.height * cut.height);
  };
  return {onDevice("affine instead of perspective interpolation", "perspective-twist",
                   [](SimulatedDevice& device) { device.affine = true; }),
          onDevice("linear filtering", "five-faces", fetching(bilinear)),
          onDevice("mipmapping", "minified", fetching(thirdLevel)),
          onDevice("repeat instead of clamp", "clamped-coordinates", fetching(repeated)),
          onDevice("half-texel shift", "five-faces", [](SimulatedDevice& device) { device.texelShift = 0.5; }),
          onDevice("truncated texture coordinates (16.8)", "perspective-clipped", fetching(truncated)),
          onInput("index map upside down", "five-faces",
                  [](TestVector& vector) {
                    raster::IndexMap& map = vector.list.indexMaps[0];
                    for (std::size_t p = 0; p < 5; ++p) std::swap(map.words[p], map.words[p + 10]);
                  }),
          onDevice("width and height of the index map exchanged", "rectangular-map", fetching(cutAtHeight)),
          onDevice("index map not sampled", "five-faces",
                   fetching([](const raster::IndexMap&, const glm::dvec2&) { return Word{0}; }))};
}

// --- words ---

std::vector<Injection> blendInjections() {
  const auto blending = [](const auto& blend) { return [=](SimulatedDevice& device) { device.blend = blend; }; };
  const auto bytes = [](const auto& sum) {
    return
        [=](Word a, Word b) { return bytewise([=](Word shift) { return sum(byteAt(a, shift), byteAt(b, shift)); }); };
  };
  const std::string layout = "layout-r8g8b8a8";
  const auto overTarget = [](Word target, Word fragment) {
    const double alpha = byteAt(fragment, 24) / 255.0;
    return bytewise([=](Word shift) {
      return static_cast<Word>(std::lround(alpha * byteAt(fragment, shift) + (1 - alpha) * byteAt(target, shift)));
    });
  };
  return {
      onDevice("modulate instead of add", layout, blending(bytes([](Word a, Word b) { return (a * b + 127) / 255; }))),
      onDevice("wrap instead of clamp", layout, blending(bytes([](Word a, Word b) { return (a + b) & 255; }))),
      onDevice("carry across channels", layout, blending([](Word a, Word b) { return a + b; })),
      onDevice("clamp instead of integer add", "integer-add-32",
               blending(bytes([](Word a, Word b) { return std::min(a + b, 255u); }))),
      onInput("offset not aligned", "many-maps",
              [](TestVector& vector) {
                Word next = 0;
                for (raster::Draw& draw : vector.list.draws) {
                  const raster::IndexMap& map = vector.list.indexMaps[static_cast<std::size_t>(*draw.indexMap)];
                  draw.offset = next;
                  next += static_cast<Word>(map.width * map.height);
                }
              }),
      onInput("colour from the wrong provoking vertex", "shared-vertices",
              [](TestVector& vector) {
                // The last vertex of a triangle is the first of the next but one; a strip's end has none.
                const std::vector<raster::Draw> draws = vector.list.draws;
                for (std::size_t t = 0; t < draws.size(); ++t)
                  vector.list.draws[t].offset = draws[std::min(t + 2, t / 15 * 15 + 14)].offset;
              }),
      onDevice("blending left on", layout, [=](SimulatedDevice& device) { device.store = overTarget; })};
}

/// 8 bits of red and blue to 5 and of green to 6, dithered by the recursive matrix of 4 x 4 thresholds, and back.
void ditherTo565(std::vector<Word>& words, std::size_t width) {
  constexpr std::array<int, 16> matrix{0, 8, 2, 10, 12, 4, 14, 6, 3, 11, 1, 9, 15, 7, 13, 5};
  for (std::size_t p = 0; p < words.size(); ++p) {
    const double threshold = (matrix[p / width % 4 * 4 + p % width % 4] + 0.5) / 16;
    const auto reduced = [&](Word shift, double largest) {
      const double level = std::floor(byteAt(words[p], shift) / 255.0 * largest + threshold);
      return static_cast<Word>(std::lround(level / largest * 255)) << shift;
    };
    words[p] = reduced(0, 31) | reduced(8, 63) | reduced(16, 31) | (words[p] & 0xff000000);
  }
}

Word encoded(Word word) {
  const auto channel = [=](Word shift) {
    const double linear = byteAt(word, shift) / 255.0;
    const double value = linear < 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
    return static_cast<Word>(std::lround(255 * value)) << shift;
  };
  return channel(0) | channel(8) | channel(16) | (word & 0xff000000);
}

/// 24 significant bits.
Word throughBinary32(Word word) {
  const double unit = std::ldexp(1.0, std::max(0, static_cast<int>(std::bit_width(word)) - 24));
  return static_cast<Word>(std::min(std::nearbyint(word / unit) * unit, 4294967295.0));
}

std::vector<Injection> memoryInjections() {
  const std::string layout = "layout-r8g8b8a8";
  return {onInput("channels swapped in the texture (BGRA)", layout,
                  [](TestVector& vector) {
                    for (Word& word : vector.list.indexMaps[0].words) word = bgra(word);
                  }),
          onInput("channels swapped in the offset (BGRA)", layout,
                  [](TestVector& vector) {
                    for (raster::Draw& draw : vector.list.draws) draw.offset = bgra(draw.offset);
                  }),
          onWords("channels swapped in the target (BGRA)", layout, everyWord(bgra)),
          onWords("byte order", layout,
                  everyWord([](Word w) { return w >> 24 | (w >> 8 & 0xff00) | (w << 8 & 0xff0000) | w << 24; })),
          onWords("words through binary32", layout, everyWord(throughBinary32)),
          onWords("alpha forced to opaque", layout, everyWord([](Word w) { return w | 0xff000000; })),
          onWords("background not cleared", "five-faces", everyWord([](Word w) { return w == 0xffffffff ? 0 : w; })),
          onWords("background not cleared", layout, everyWord([](Word w) { return w == 0xffffffff ? 0xff000000 : w; })),
          onWords("padded rows", "rectangular-map",
                  [](std::vector<Word>& words, std::size_t width) {
                    std::vector<Word> padded;  // 42 words a row, padded to 48: 3 times 64 bytes
                    for (std::size_t row = 0; row < words.size() / width; ++row) {
                      padded.insert(padded.end(), &words[row * width], &words[row * width] + width);
                      padded.insert(padded.end(), 6, 0);
                    }
                    std::copy_n(padded.begin(), words.size(), words.begin());
                  }),
          onWords("sRGB encoding", layout, everyWord(encoded)),
          onWords("dithering", layout, ditherTo565)};
}

}  // namespace

std::vector<Injection> injectedFaults() {
  std::vector<Injection> all;
  for (const auto& some : {viewInjections, sampleInjections, textureInjections, blendInjections, memoryInjections})
    for (Injection& injection : some()) all.push_back(std::move(injection));
  return all;
}

}  // namespace hemitex::tests
