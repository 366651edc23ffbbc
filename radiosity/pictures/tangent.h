/// The tangent without libm, whose last digits differ between machines.
#pragma once

namespace hemitex::radiosity {

/// The tangent of an angle in degrees, in [0, 90), with a relative error of at most 1e-14.
double tangentOfDegrees(double degrees);

}  // namespace hemitex::radiosity
