/// The texts of files that are compiled into the program, so that its pages need no other files.
#pragma once

namespace hemitex::cli {

extern const char* const benchPageText;     ///< cli/bench/report.html
extern const char* const tradeoffPageText;  ///< cli/tradeoff/report.html
extern const char* const paperPageText;     ///< cli/paper/report.html
extern const char* const pageStyle;         ///< page_style.css
extern const char* const pageScript;        ///< page_script.js
extern const char* const chartLibrary;      ///< Chart.js, minified, with its licence

}  // namespace hemitex::cli
