#include "data/generate/models.h"

namespace hemitex::data {

std::vector<Model> allModels() {
  return {paperRoom(), cornellBox(), pyramidRoom(), curvedRoom(), gallery(), plant(), furnishedRoom()};
}

}  // namespace hemitex::data
