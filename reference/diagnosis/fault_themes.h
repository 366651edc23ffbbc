/// The themes of the known faults, a source file each, in the order of the stages.
#pragma once

#include "reference/diagnosis/fault.h"

namespace hemitex::reference {

std::vector<Fault> viewFaults(const TestVector& vector);     ///< flipped, exchanged, turned, moved views and pictures
std::vector<Fault> sampleFaults(const TestVector& vector);   ///< facing, coverage and depth
std::vector<Fault> textureFaults(const TestVector& vector);  ///< how index maps are looked up
std::vector<Fault> blendFaults(const TestVector& vector);    ///< offsets, and how they meet texels and the target
std::vector<Fault> memoryFaults(const TestVector& vector);   ///< words in memory: channels, bytes, bits, rows, colours

}  // namespace hemitex::reference
