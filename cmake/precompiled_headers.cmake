# What nearly every source includes: each library parses it once.
set(HEMITEX_PRECOMPILED_HEADERS <algorithm> <array> <cmath> <cstdint> <filesystem> <functional> <glm/glm.hpp> <map>
  <memory> <optional> <span> <string> <vector>)
