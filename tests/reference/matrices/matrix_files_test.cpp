// Files of matrices: what is written reads back bit by bit, SciPy agrees, and damaged files are refused.
#include "reference/matrices/matrix_files.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>

#include "raster/base/input_error.h"
#include "tests/support/shell.h"
#include "tests/support/temporary_folder.h"

using namespace hemitex;
using namespace hemitex::reference;
using tests::readAll;
using tests::writeAll;

namespace {

constexpr std::size_t facets = 23;

MatrixHeading headingOf(std::size_t count) {
  MatrixHeading heading;
  for (std::size_t f = 0; f < count; ++f) {
    heading.area.push_back(1 / (static_cast<double>(f) + 3));
    heading.names.push_back("wall\n" + std::to_string(f));
  }
  return heading;
}

/// Entries of all sizes that binary64 has; row 4 is empty.
SparseMatrix randomMatrix() {
  std::mt19937 random(7);
  SparseMatrix matrix{.columns = facets + 2};
  for (std::size_t r = 0; r < facets; ++r) {
    SparseMatrix row;
    for (std::uint32_t c = 0; c < matrix.columns && r != 4; ++c) {
      if (random() % 3 != 0) continue;
      row.column.push_back(c);
      row.value.push_back(std::ldexp(static_cast<double>(random()) / 0x1p32, -static_cast<int>(random() % 1070)));
    }
    matrix.append({row.column, row.value});
  }
  matrix.value[0] = std::numeric_limits<double>::denorm_min();
  matrix.value[1] = 1 - 0x1p-53;
  return matrix;
}

void write(const SparseMatrix& matrix, const std::filesystem::path& file) {
  const auto writer = matrixSink(file, headingOf(matrix.rows()));
  for (std::size_t r = 0; r < matrix.rows(); ++r) writer->write(matrix.row(r));
  writer->finish();
  CHECK(!std::filesystem::exists(file.string() + ".data"));
  CHECK(!std::filesystem::exists(file.string() + ".indices"));
}

bool isRefused(const std::filesystem::path& file) {
  try {
    readMatrix(file);
  } catch (const raster::InputError& error) {
    return error.file().starts_with(file.string());
  }
  return false;
}

template <typename Value>
std::string bytes(const std::vector<Value>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(Value)};
}

/// The first line of View3D's files, by the rules of its source: 30 characters, then the end of the line.
std::string view3dHeader(int format, int surfaces, const std::string& end) {
  std::string line = "View3D 3.3 " + std::to_string(format) + " 0 0 " + std::to_string(surfaces);
  line.resize(30, ' ');
  return line + end;
}

const SparseMatrix threeByThree{
    .columns = 3, .rowStart = {0, 2, 4, 5}, .column = {1, 2, 0, 2, 0}, .value = {0.25, 0.5, 0.125, 0.75, 0.0625}};
const std::vector<float> dense{0, 0.25F, 0.5F, 0.125F, 0, 0.75F, 0.0625F, 0, 0};

}  // namespace

TEST_CASE("matrixSink writes what readMatrix reads, bit by bit", "[matrices]") {
  const TemporaryFolder folder;
  const SparseMatrix matrix = randomMatrix();
  for (const char* name : {"F.npz", "F.mtx", "F.csv"}) {
    INFO(name);
    write(matrix, folder.path / name);
    const MatrixFile read = readMatrix(folder.path / name);
    CHECK(read.matrix == matrix);
    if (std::string(name) == "F.npz") CHECK(read.area == headingOf(facets).area);
  }
  CHECK(std::distance(std::filesystem::directory_iterator(folder.path), {}) == 3);
}

TEST_CASE("matrixSink leaves out entries that are 0, and writes the same bytes each time", "[matrices]") {
  const TemporaryFolder folder;
  for (const char* name : {"F.npz", "F.mtx", "F.csv"}) {
    INFO(name);
    for (const std::string copy : {"a", "b"}) {
      const auto writer = matrixSink(folder.path / (copy + name), headingOf(2));
      const std::vector<std::uint32_t> columns{0, 1, 3};
      writer->write({columns, std::vector<double>{0.0, 0.5, 0.5}});
      writer->write({columns, std::vector<double>{0.25, -0.0, 0.75}});
      writer->finish();
    }
    CHECK(readMatrix(folder.path / ("a" + std::string(name))).matrix ==
          SparseMatrix{4, {0, 2, 4}, {1, 3, 0, 3}, {0.5, 0.5, 0.25, 0.75}});
    CHECK(readAll(folder.path / ("a" + std::string(name))) == readAll(folder.path / ("b" + std::string(name))));
  }
}

TEST_CASE("readMatrix reads View3D's text and binary files", "[matrices]") {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path / "F.vf";
  const std::string text = view3dHeader(0, 3, "\n") +
                           "1.5 2 4e-3\n0.000000 0.250000 0.500000\n0.125000 0.000000 0.750000\n"
                           "0.062500 0.000000 0.000000\n0.900 0.900 0.900\n";
  writeAll(file, text);
  CHECK(readMatrix(file).matrix == threeByThree);
  CHECK(readMatrix(file).area == std::vector<double>{1.5, 2, 4e-3});
  const std::string binary = view3dHeader(1, 3, "\r\n") + bytes(std::vector<float>{1.5F, 2, 0.5F}) + bytes(dense) +
                             bytes(std::vector<float>(3, 0.9F));
  writeAll(file, binary);
  CHECK(readMatrix(file).matrix == threeByThree);
  CHECK(readMatrix(file).area == std::vector<double>{1.5, 2, 0.5});
  for (std::size_t size = 0; size < binary.size(); ++size) {
    writeAll(file, binary.substr(0, size));
    INFO(size);
    CHECK(isRefused(file));
  }
  writeAll(file, binary + "x");
  CHECK(isRefused(file));
  for (std::size_t size = 0; size < text.size() - 6; ++size) {
    writeAll(file, text.substr(0, size));
    INFO(size);
    CHECK(isRefused(file));
  }
}

TEST_CASE("readMatrix reads triples from 0 or 1, and dense CSV", "[matrices]") {
  const TemporaryFolder folder;
  const auto read = [&](const std::string& name, const std::string& text) {
    writeAll(folder.path / name, text);
    return readMatrix(folder.path / name).matrix;
  };
  CHECK(read("F.txt", "# i j F\n1 2 .25\n1 3 .5\n3 1 .0625\n2 1 0.125\n2 3 7.5e-1\n") == threeByThree);
  CHECK(read("F.txt", "0 1 .25\r\n0, 2, .5\r\n1\t0 .125\n1;2;.75\n\n2 0 .0625") == threeByThree);
  CHECK(read("F.txt",
             "\xEF\xBB\xBF"
             "0 1 .25\r0 2 .5 # seen\r1 0 .125\r1 2 .75\r2 0 .0625\r") == threeByThree);
  CHECK(read("F.csv", "0,.25,.5\n.125,1e-999,.75\n0.0625,0,0\n") == threeByThree);
  CHECK(read("F.csv", "from,to,form_factor\n0,1,.25\n0,2,.5\n1,0,.125\n1,2,.75\n2,0,.0625\n") == threeByThree);
  CHECK(read("F.csv", "from,to,form_factor\n0,backs,1\n1,0,.5\n1,surroundings,.5\n") ==
        SparseMatrix{4, {0, 1, 3}, {3, 0, 2}, {1, .5, .5}});
}

TEST_CASE("readMatrix refuses what is no matrix, with the line", "[matrices]") {
  const TemporaryFolder folder;
  const std::string market = "%%MatrixMarket matrix coordinate real general\n";
  for (const auto& [name, text, line] : std::vector<std::tuple<const char*, std::string, int>>{
           {"F.obj", "v 0 0 0\n", 0},
           {"F.mtx", "", 1},
           {"F.mtx", "%%MatrixMarket matrix array real general\n2 2\n", 1},
           {"F.mtx", "%%MatrixMarket matrix coordinate real symmetric\n2 2 0\n", 1},
           {"F.mtx", market, 2},
           {"F.mtx", market + "% comment\n0 2 1\n", 3},
           {"F.mtx", market + "2 2\n", 2},
           {"F.mtx", market + "2 2 5\n", 2},
           {"F.mtx", market + "2 3 0\n", 0},
           {"F.mtx", market + "2000000000 2000000000 0\n", 3},
           {"F.mtx", market + "2 2 2\n1 2 0.5\n", 4},
           {"F.mtx", market + "2 2 1\n1 2 0.5\n2 1 0.5\n", 4},
           {"F.mtx", market + "2 2 1\n3 2 0.5\n", 3},
           {"F.mtx", market + "2 2 1\n1 0 0.5\n", 3},
           {"F.mtx", market + "2 2 1\n1 2 nan\n", 3},
           {"F.mtx", market + "2 2 1\n1 2 1e999\n", 3},
           {"F.mtx", market + "2 2 1\n1 2 0.5 0.5\n", 3},
           {"F.mtx", market + "2 2 2\n1 2 0.5\n1 2 0.5\n", 0},
           {"F.csv", "", 1},
           {"F.csv", "from,to,form_factor\n", 0},
           {"F.csv", "from,to,form_factor\nwall,1,0.5\n", 2},
           {"F.csv", "from,to,form_factor\nbacks,1,0.5\n", 2},
           {"F.csv", "from,to,form_factor\n0,-1,0.5\n", 2},
           {"F.csv", "from,to,form_factor\n0,1,inf\n", 2},
           {"F.csv", "from,to,form_factor\n0,1\n", 2},
           {"F.csv", "from,to,form_factor\n0,2000000000,0.5\n", 3},
           {"F.csv", "0,0.5\n0.5\n", 2},
           {"F.csv", "0,0.5\n", 0},
           {"F.csv", "0,x\n0,0\n", 1},
           {"F.txt", "", 0},
           {"F.txt", "1 2\n", 1},
           {"F.txt", "1 2 0.5\n1 2 0.25\n", 0},
           {"F.txt", "1 4000000000 0.5\n", 1},
           {"F.vf", "View3D 3.3 2 0 0 1\n", 1},
           {"F.vf", "View3D 3.3 0 0 0 0\n", 1},
           {"F.vf", "View3D 3.3 0 0 0 1\n1\n-nan\n0.9\n", 3},
           {"F.npz", "PK", 0}}) {
    INFO(name << ": " << text);
    writeAll(folder.path / name, text);
    try {
      readMatrix(folder.path / name);
      FAIL("is read");
    } catch (const raster::InputError& error) {
      CHECK(error.line() == line);
      CHECK(error.file() == (folder.path / name).string());
    }
  }
}

TEST_CASE("readMatrix finds each changed bit and each lost byte of an npz file", "[matrices]") {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path / "F.npz";
  const SparseMatrix matrix{4, {0, 2, 3}, {1, 3, 0}, {0.25, 0.75, 1}};
  write(matrix, file);
  const std::string whole = readAll(file);
  int refused = 0;
  for (std::size_t i = 0; i < whole.size(); ++i) {
    std::string damaged = whole;
    damaged[i] = static_cast<char>(damaged[i] ^ 4);
    writeAll(file, damaged);
    if (isRefused(file)) {
      ++refused;
    } else {
      INFO(i);
      CHECK(readMatrix(file).matrix == matrix);
    }
  }
  CHECK(refused > static_cast<int>(whole.size()) / 2);
  for (std::size_t size = 0; size < whole.size(); ++size) {
    writeAll(file, whole.substr(0, size));
    INFO(size);
    CHECK(isRefused(file));
  }
}

TEST_CASE("checkAndSort sorts rows, and refuses rows that are none", "[matrices]") {
  const auto checked = [](SparseMatrix matrix) {
    checkAndSort(matrix, "F.npz");
    return matrix;
  };
  CHECK(checked({3, {0, 3, 3}, {2, 0, 1}, {.5, .25, .125}}) == SparseMatrix{3, {0, 3, 3}, {0, 1, 2}, {.25, .125, .5}});
  for (const SparseMatrix& wrong :
       {SparseMatrix{3, {0, 1}, {3}, {.5}}, SparseMatrix{3, {0, 2}, {1}, {.5}}, SparseMatrix{3, {1, 1}, {1}, {.5}},
        SparseMatrix{3, {0, 2, 1, 2}, {1, 2}, {.5, .5}}, SparseMatrix{3, {0, 2}, {1, 1}, {.5, .5}},
        SparseMatrix{3, {0, 1}, {1, 2}, {.5}}, SparseMatrix{3, {0, 1}, {1}, {std::nan("")}},
        SparseMatrix{maxColumns, {0, 1}, {1}, {.5}}, SparseMatrix{3, {}, {}, {}}})
    CHECK_THROWS_AS(checked(wrong), raster::InputError);
}

TEST_CASE("SciPy reads what matrixSink writes, and readMatrix what SciPy writes", "[matrices][scipy]") {
  const tests::Shell shell;
  if (shell.execute("/usr/bin/python3 -c 'import scipy'").exitCode != 0) {
    WARN("skipped: SciPy is not installed");
    return;
  }
  const SparseMatrix matrix = randomMatrix();
  for (const char* name : {"F.npz", "F.mtx", "F.csv"}) write(matrix, shell.file(name));
  writeAll(shell.file("script.py"), R"(
import json, numpy, scipy.io, scipy.sparse
F = scipy.sparse.load_npz('F.npz')
assert F.format == 'csr' and F.has_canonical_format and F.shape == (23, 25) and F.dtype == numpy.float64
assert F.indices.dtype == F.indptr.dtype == numpy.int32
M = scipy.io.mmread('F.mtx').tocsr()
assert (F != M).nnz == 0 and F.nnz == M.nnz
with numpy.load('F.npz') as arrays:
    assert arrays['area'].tolist() == [1 / (f + 3) for f in range(23)]
    about = json.loads(arrays['about'].item())
    assert about['column_surroundings'] == 23 and about['column_backs'] == 24 and about['names'][3] == 'wall\n3'
scipy.sparse.save_npz('deflated.npz', F)
scipy.sparse.save_npz('stored.npz', F, compressed=False)
scipy.io.mmwrite('scipy.mtx', F, precision=17)
wide = scipy.sparse.csr_matrix((F.data, F.indices.astype(numpy.int64), F.indptr.astype(numpy.int64)), F.shape)
wide.indices, wide.indptr = F.indices.astype(numpy.int64), F.indptr.astype(numpy.int64)
scipy.sparse.save_npz('wide.npz', wide)
scipy.sparse.save_npz('single.npz', F.astype(numpy.float32))
scipy.sparse.save_npz('columns.npz', F.tocsc())
scipy.sparse.save_npz('integers.npz', (F != 0).astype(numpy.int64))
)");
  const tests::Outcome outcome = shell.execute("/usr/bin/python3 script.py");
  INFO(outcome.err);
  REQUIRE(outcome.exitCode == 0);
  for (const char* name : {"deflated.npz", "stored.npz", "wide.npz", "scipy.mtx"}) {
    INFO(name);
    CHECK(readMatrix(shell.file(name)).matrix == matrix);
  }
  SparseMatrix rounded = matrix;
  for (double& value : rounded.value) value = static_cast<float>(value);
  CHECK(readMatrix(shell.file("single.npz")).matrix == rounded);
  for (const char* name : {"columns.npz", "integers.npz"}) {
    INFO(name);
    CHECK(isRefused(shell.file(name)));
  }
}
