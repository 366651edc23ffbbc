/// The fault that explains a wrong matrix of form factors. Each known fault predicts another matrix, such as the
/// transposed one; the one whose prediction fits the measured rows far better than the truth is named.
#pragma once

#include <optional>
#include <string>

#include "reference/matrices/judged_rows.h"

namespace hemitex::reference {

/// The name of the fault; nothing if no known one explains the matrix. `isOutsideWrong` says that surroundings or backs
/// are wrong.
std::optional<std::string> matrixFault(const JudgedMatrix& matrix, const JudgedRows& rows,
                                       const JudgeSettings& settings, bool isOutsideWrong);

}  // namespace hemitex::reference
