/// Rows that a device draws together before a solution needs them, because many at once take less time. The patches
/// with the most unshot flux will shoot soon. A row depends on nothing but its points, so the solution has the same
/// bits as without this.
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "radiosity/form_factors/patch_rows.h"
#include "radiosity/form_factors/scene_form_factors.h"

namespace hemitex::radiosity {

class RowsTogether {
 public:
  /// `formFactors` must outlive this object.
  explicit RowsTogether(SceneFormFactors& formFactors) : formFactors_(formFactors) {}

  /// Draws the rows of likely shots, if that of the next one is missing. Call it after each shot.
  void lookAhead(const NextShots& shots);
  /// The row of a patch.
  FormFactorRow row(const Patch& patch);

 private:
  struct Row {
    std::vector<ViewPoint> points;
    FormFactorRow row;
  };

  SceneFormFactors& formFactors_;
  std::map<std::uint32_t, Row> ahead_;  ///< by patch
};

}  // namespace hemitex::radiosity
