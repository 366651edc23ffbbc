#include "raster/base/short_number.h"

#include <iomanip>
#include <sstream>

namespace hemitex::raster {

std::string shortNumber(double value) {
  std::ostringstream text;
  text << std::setprecision(3) << value;
  return text.str();
}

}  // namespace hemitex::raster
