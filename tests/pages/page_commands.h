/// Runs the commands of a Markdown page, so that what they print and draw can be compared with the page.
///
/// A command is a line of a code block (four blanks) that begins with "$ ". Lines that begin with "> " continue it. The
/// lines that follow are what it prints on stdout and stderr, without blank lines. A command that fails ends with a
/// line
/// "(exit code N)".
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace hemitex::pages {

/// The page with what its commands print now. They run in order, by sh, in `folder`. `programs` is the first folder of
/// the PATH. Throws std::runtime_error if a command cannot be started.
std::string withOutputs(const std::string& page, const std::filesystem::path& folder,
                        const std::filesystem::path& programs);

/// The text with "# s" for every time in seconds, such as "0.25 s".
std::string withoutTimes(const std::string& text);

/// The PNG files that a page shows, as it names them. The file `tutorial/x.png` is `out/tutorial/x.png` for the
/// commands.
std::vector<std::string> picturesOf(const std::string& page);

}  // namespace hemitex::pages
