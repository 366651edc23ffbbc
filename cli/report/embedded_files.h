/// The texts of files that are compiled into the program, so that its pages need no other files.
#pragma once

namespace hemitex::cli {

extern const char* const benchPageText;     ///< cli/bench/report.html
extern const char* const tradeoffPageText;  ///< cli/tradeoff/report.html
extern const char* const paperPageText;     ///< cli/paper/report.html
extern const char* const solvedPageText;    ///< cli/view/report.html
extern const char* const pageStyle;         ///< page_style.css
extern const char* const pageScript;        ///< page_script.js
extern const char* const chartLibrary;      ///< Chart.js, minified, with its licence
extern const char* const sceneLibrary;      ///< three.js with OrbitControls and GLTFLoader; licence in view/report.html

}  // namespace hemitex::cli
