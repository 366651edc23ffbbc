/// The texts of files that are compiled into the program, so that its pages need no other files.
#pragma once

namespace hemitex::cli {

extern const char* const benchPageText;     ///< cli/report/bench.html
extern const char* const tradeoffPageText;  ///< cli/report/tradeoff.html
extern const char* const paperPageText;     ///< cli/report/paper.html
extern const char* const solvedPageText;    ///< cli/report/solved.html
extern const char* const pageStyle;         ///< page_style.css
extern const char* const pageScript;        ///< page_script.js
extern const char* const chartLibrary;      ///< Chart.js, minified, with its licence
extern const char* const sceneLibrary;      ///< three.js with OrbitControls and GLTFLoader; licence in solved.html

}  // namespace hemitex::cli
