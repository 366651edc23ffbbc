#include "reference/truth/rays/embree_form_factors.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <glm/gtc/bitfield.hpp>
#include <limits>
#include <numbers>
#include <utility>

#include "radiosity/projection/patch_view.h"
#include "raster/base/parallel.h"
#include "reference/truth/rays/embree_scene.h"
#include "reference/truth/rays/ray_caster.h"
#include "reference/truth/rays/sample_points.h"

namespace hemitex::reference {
namespace {

using std::numbers::pi;
constexpr std::size_t packetSize = 16;
/// Packets per task.
constexpr std::size_t packetsAtOnce = 64;
/// Results of rays that meet no element.
constexpr std::uint32_t background = 0xffffffff, back = 0xfffffffe;

/// A sample of the sequence: a direction around the axis z, and the point of the unit square for its start.
struct Sample {
  glm::vec3 direction;
  glm::vec2 start;
};

/// Maps the square to the unit disk so that equal areas stay equal and squares stay compact (Shirley and Chiu 1997):
/// rings of squares become rings.
glm::dvec2 onDisk(double x, double y) {
  const double a = 2 * x - 1, b = 2 * y - 1;
  const bool alongX = std::abs(a) > std::abs(b);
  const double radius = alongX ? a : b;
  const double angle = alongX ? pi / 4 * (b / a) : b == 0 ? 0 : pi / 2 - pi / 4 * (a / b);
  return radius * glm::dvec2(std::cos(angle), std::sin(angle));
}

/// Directions over the hemisphere, uniform in projected solid angle (Malley 1988). They are sorted along a Z-order
/// curve over the square, so that consecutive directions are neighbours and packets are coherent.
std::vector<Sample> samplesOf(int count, std::uint32_t seed) {
  const SamplePoints points(static_cast<std::size_t>(count), seed);
  std::vector<std::pair<std::uint32_t, std::uint32_t>> order;
  for (std::uint32_t i = 0; i < points.count(); ++i) {
    const SamplePoint point = points.at(0, i);
    const auto cell = [](double coordinate) { return static_cast<glm::uint16>(coordinate * 0x1p16); };
    order.emplace_back(glm::bitfieldInterleave(cell(point[0]), cell(point[1])), i);
  }
  std::sort(order.begin(), order.end());
  std::vector<Sample> samples;
  for (const auto& [place, i] : order) {
    const SamplePoint point = points.at(0, i);
    const glm::dvec2 disk = onDisk(point[0], point[1]);
    samples.push_back({glm::vec3(disk, std::sqrt(std::max(0.0, 1 - glm::dot(disk, disk)))), {point[2], point[3]}});
  }
  return samples;
}

/// The start of a ray, and the axes of its direction.
struct Origin {
  glm::vec3 start;
  glm::vec3 x, y, normal;
};

/// `turn` is the position of the axis x on the unit circle about the normal.
Origin originAt(const ShootingPoint& point, const glm::dvec3& middle, const glm::dvec2& turn) {
  const glm::dvec3 inward = middle - point.position;
  const double distance = glm::length(inward);
  const double share = distance > 0 ? std::min(0.5, radiosity::eyeInset / distance) : 0;
  const glm::dvec3 axis = std::abs(point.normal.x) < 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
  const glm::dvec3 right = glm::normalize(glm::cross(axis, point.normal)), up = glm::cross(point.normal, right);
  return {point.position + share * inward + radiosity::eyeHeight * point.normal, turn.x * right + turn.y * up,
          turn.x * up - turn.y * right, point.normal};
}

/// The point on the unit circle for the same rotation as hemicubes have. It uses the full circle, because rays have no
/// symmetry.
glm::dvec2 onCircle(double turn) { return {std::cos(2 * pi * turn), std::sin(2 * pi * turn)}; }

void aim(RTCRayHit16& packet, std::size_t i, const Origin& from, const glm::vec3& local) {
  const glm::vec3 direction = local.x * from.x + local.y * from.y + local.z * from.normal;
  RTCRay16& ray = packet.ray;
  ray.org_x[i] = from.start.x;
  ray.org_y[i] = from.start.y;
  ray.org_z[i] = from.start.z;
  ray.tnear[i] = 0;
  ray.dir_x[i] = direction.x;
  ray.dir_y[i] = direction.y;
  ray.dir_z[i] = direction.z;
  ray.time[i] = 0;
  ray.tfar[i] = std::numeric_limits<float>::infinity();
  ray.mask[i] = ~0U;
  ray.id[i] = 0;
  ray.flags[i] = 0;
  packet.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
}

/// Whether the ray meets the triangle on its front, where it is counter-clockwise.
bool meetsFront(const RTCRayHit16& packet, std::size_t i) {
  return packet.ray.dir_x[i] * packet.hit.Ng_x[i] + packet.ray.dir_y[i] * packet.hit.Ng_y[i] +
             packet.ray.dir_z[i] * packet.hit.Ng_z[i] <
         0;
}

/// The filter callback of Embree, which accepts or rejects hits.
void passBacksAndHoles(const RTCFilterFunctionNArguments* arguments) {
  const auto* triangles = static_cast<const SceneTriangle*>(arguments->geometryUserPtr);
  const unsigned count = arguments->N;
  for (unsigned i = 0; i < count; ++i) {
    if (arguments->valid[i] == 0) continue;
    const SceneTriangle& triangle = triangles[RTCHitN_primID(arguments->hit, count, i)];
    const glm::dvec2 weights(RTCHitN_u(arguments->hit, count, i), RTCHitN_v(arguments->hit, count, i));
    if (triangle.holed && radiosity::isHole(*triangle.holed->cutOut, triangle.holed->triangle, weights)) {
      arguments->valid[i] = 0;
      continue;
    }
    if (!triangle.isBacked) continue;
    const float along = RTCRayN_dir_x(arguments->ray, count, i) * RTCHitN_Ng_x(arguments->hit, count, i) +
                        RTCRayN_dir_y(arguments->ray, count, i) * RTCHitN_Ng_y(arguments->hit, count, i) +
                        RTCRayN_dir_z(arguments->ray, count, i) * RTCHitN_Ng_z(arguments->hit, count, i);
    if (along >= 0) arguments->valid[i] = 0;
  }
}

/// `triangles` must live as long as the tree.
EmbreeScene treeOver(const radiosity::Scene& scene, std::vector<SceneTriangle>& triangles) {
  return embreeTree([&](RTCDevice device) {
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* corner = static_cast<glm::vec3*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(glm::vec3), 3 * triangles.size()));
    auto* index = static_cast<std::uint32_t*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(std::uint32_t), triangles.size()));
    for (std::size_t t = 0; t < triangles.size(); ++t) {
      const auto corners = inFrame(scene, radiosity::placed(scene, triangles[t].place));
      std::copy(corners.begin(), corners.end(), corner + 3 * t);
    }
    for (std::uint32_t i = 0; i < 3 * triangles.size(); ++i) index[i] = i;
    rtcSetGeometryUserData(geometry, triangles.data());
    if (std::any_of(triangles.begin(), triangles.end(),
                    [](const SceneTriangle& triangle) { return triangle.isBacked || triangle.holed; }))
      rtcSetGeometryIntersectFilterFunction(geometry, passBacksAndHoles);
    return geometry;
  });
}

}  // namespace

struct RayRows::Implementation {
  const radiosity::Scene& scene;
  const radiosity::Discretization& discretization;
  RayStart start;
  std::vector<Sample> samples;
  SurfacePieces pieces;  ///< empty if rays start at centres
  std::vector<SceneTriangle> triangles;
  EmbreeScene tree;
  std::vector<std::uint32_t> met;     ///< per ray: an element, `background` or `back`
  std::vector<std::uint64_t> counts;  ///< number of rays per element, all 0 between rows

  RaySource shooterOf(const radiosity::Patch& patch) const;
  std::uint32_t whatIsMet(const RTCRayHit16& packet, std::size_t i) const;
  radiosity::FormFactorRow count();
};

RayRows::RayRows(const radiosity::Scene& scene, const radiosity::Discretization& discretization,
                 const RayRowSettings& settings) {
  assert(settings.rays >= static_cast<int>(packetSize) && settings.rays <= 1 << 24);
  assert(std::has_single_bit(static_cast<unsigned>(settings.rays)));
  implementation_.reset(new Implementation{
      scene, discretization, settings.start, samplesOf(settings.rays, settings.seed),
      settings.start == RayStart::Area ? surfacePieces(scene, discretization) : SurfacePieces{}, sceneTriangles(scene),
      EmbreeScene{}, std::vector<std::uint32_t>(static_cast<std::size_t>(settings.rays)),
      std::vector<std::uint64_t>(discretization.elements.size())});
  implementation_->tree = treeOver(scene, implementation_->triangles);
}

RayRows::~RayRows() = default;

RaySource RayRows::Implementation::shooterOf(const radiosity::Patch& patch) const {
  if (start == RayStart::Area) return areaRaySource(pieces, patch.elements);
  return pointRaySource(scene, patch.surface, radiosity::patchCentre(scene, discretization, patch));
}

std::uint32_t RayRows::Implementation::whatIsMet(const RTCRayHit16& packet, std::size_t i) const {
  if (packet.hit.geomID[i] == RTC_INVALID_GEOMETRY_ID) return background;
  if (!meetsFront(packet, i)) return back;
  return elementAt(triangles[packet.hit.primID[i]], discretization, {packet.hit.u[i], packet.hit.v[i]});
}

/// All rays have the same weight.
radiosity::FormFactorRow RayRows::Implementation::count() {
  radiosity::FormFactorRow row;
  const std::uint64_t share = radiosity::wholeShare / met.size();
  for (const std::uint32_t what : met) {
    if (what == background) {
      row.background += share;
    } else if (what == back) {
      row.back += share;
    } else if (counts[what]++ == 0) {
      row.elements.push_back(what);
    }
  }
  std::sort(row.elements.begin(), row.elements.end());
  for (const std::uint32_t element : row.elements) row.shares.push_back(share * std::exchange(counts[element], 0));
  return row;
}

radiosity::FormFactorRow RayRows::ofPatch(const radiosity::Patch& patch) {
  Implementation& our = *implementation_;
  const RaySource raySource = our.shooterOf(patch);
  const glm::dvec2 turn = onCircle(radiosity::turnOf(patch.number, 0));
  const auto originOf = [&](const glm::vec2& square) {
    const ShootingPoint point = shootingPoint(raySource, square.x, square.y);
    const auto corner = inFrame(our.scene, *our.triangles[point.triangle].triangle);
    return originAt(point, (corner[0] + corner[1] + corner[2]) / 3.0, turn);
  };
  const Origin centre = originOf({0.5F, 0.5F});
  const auto shoot = [&](std::size_t first) {
    RTCRayHit16 packet;
    for (std::size_t i = 0; i < packetSize; ++i) {
      const Sample& sample = our.samples[first + i];
      aim(packet, i, our.start == RayStart::Area ? originOf(sample.start) : centre, sample.direction);
    }
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    alignas(64) std::array<int, packetSize> all;
    all.fill(-1);
    rtcIntersect16(all.data(), our.tree.scene.get(), &context, &packet);
    for (std::size_t i = 0; i < packetSize; ++i) our.met[first + i] = our.whatIsMet(packet, i);
  };
  const std::size_t packets = our.samples.size() / packetSize;
  raster::parallelFor((packets + packetsAtOnce - 1) / packetsAtOnce, [&](std::size_t batch) {
    const std::size_t end = std::min(packets, (batch + 1) * packetsAtOnce);
    for (std::size_t packet = batch * packetsAtOnce; packet < end; ++packet) shoot(packet * packetSize);
  });
  return our.count();
}

}  // namespace hemitex::reference
