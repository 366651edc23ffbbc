#include "cli/common/staging.h"

#include <string>
#include <vector>

#include "raster/base/input_error.h"

namespace hemitex::cli {
namespace {

namespace fs = std::filesystem;

/// Creates a new folder in `parent`.
fs::path createTemporary(const fs::path& parent, const std::string& name) {
  for (int attempt = 0;; ++attempt) {
    const fs::path folder = parent / ('.' + name + ".partial-" + std::to_string(attempt));
    if (fs::create_directory(folder)) return folder;
  }
}

}  // namespace

Staging::Staging(const fs::path& folder) {
  try {
    const fs::path absolute = fs::absolute(folder).lexically_normal();
    final_ = absolute.has_filename() ? absolute : absolute.parent_path();
    if (fs::exists(final_)) {
      staged_ = createTemporary(final_, "hemitex");
    } else {
      fs::create_directories(final_.parent_path());
      staged_ = createTemporary(final_.parent_path(), final_.filename().string());
    }
  } catch (const fs::filesystem_error& error) {
    throw raster::InputError(folder.string(), 0, "is not a folder that can be written: " + error.code().message(),
                             "choose another folder with -o");
  }
}

Staging::~Staging() {
  std::error_code ignored;
  fs::remove_all(staged_, ignored);
}

void Staging::commit() {
  try {
    if (!fs::exists(final_)) {
      fs::rename(staged_, final_);
      return;
    }
    std::vector<fs::path> names;
    for (const fs::directory_entry& entry : fs::directory_iterator(staged_)) names.push_back(entry.path().filename());
    for (const fs::path& name : names) {
      // A folder cannot replace a folder that holds files.
      if (fs::is_directory(staged_ / name)) fs::remove_all(final_ / name);
      fs::rename(staged_ / name, final_ / name);
    }
  } catch (const fs::filesystem_error& error) {
    throw raster::InputError(final_.string(), 0, "the result cannot be moved here: " + error.code().message());
  }
}

}  // namespace hemitex::cli
