/// Test vectors that JavaScript holds. A vector does not change (see scenes.h).
#pragma once

#include <memory>
#include <string>
#include <utility>

#include "reference/conformance/vectors/vector_file.h"
#include "web/bindings/values.h"

namespace hemitex::web {

struct VectorHandle {
  explicit VectorHandle(reference::TestVector given)
      : vector(std::make_shared<const reference::TestVector>(std::move(given))) {}

  std::string name() const { return vector->name; }
  std::string catches() const { return vector->catches; }
  Value json() const;
  Value arrays() const;
  Value render() const;
  Value explain(const std::string& face, int column, int row) const;

  std::shared_ptr<const reference::TestVector> vector;
};

inline std::shared_ptr<VectorHandle> handleOf(reference::TestVector vector) {
  return std::make_shared<VectorHandle>(std::move(vector));
}

}  // namespace hemitex::web
