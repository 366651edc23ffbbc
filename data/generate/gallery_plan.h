/// The plan of the gallery (gallery.cpp): its measures, and the functions that add its parts. x points to the gallery's
/// side, the right one, and -z to the apse; lengths are in metres and invented. Each function adds groups.
#pragma once

#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "data/generate/furniture.h"
#include "data/generate/model.h"
#include "data/generate/walls.h"

namespace hemitex::data {

// The plan: four bays, an arcade of two walls' thickness to each side, aisles behind it.
inline constexpr int bays = 4;
inline constexpr double bayLength = 3.4, halfLength = bays * bayLength / 2;
inline constexpr double naveSide = 3, aisleSide = 3.6,
                        outerSide = 6.6;  // the wall of the arcade stands between the first two
inline constexpr double pierHalf = (aisleSide - naveSide) / 2, pierMiddle = (naveSide + aisleSide) / 2;
inline constexpr double stripHalf = 0.42;  // of plinths and abaci

// Heights.
inline constexpr double spring = 2.9, aisleHeight = 4.5, naveHeight = 4.8;
inline constexpr double ribRadius = 3, vaultRadius = 3.15, ribHalf = 0.25;
inline constexpr int archSegments = 16, vaultSegments = 16;

// The landing before the apse, with three risers.
inline constexpr double landing = 0.45, riser = 0.15, tread = 0.35, landingHalf = 2.4, landingEnd = -halfLength + 1.4;
inline constexpr double apseRadius = 2, apseSpring = 2.7;

// The round room, and its bay.
inline constexpr double rotundaRadius = 2.4, rotundaX = 9.2, rotundaZ = -bayLength / 2, portalHeight = 2.5,
                        drumHeight = 3;
inline constexpr int rotundaCorners = 24;

// Bays of the library.
inline constexpr int bookcaseBay = 1, paintedBay = 3;
inline constexpr double nicheDepth = 0.32;  // of a shelf

double bayMiddle(int bay);
double bayStart(int bay);
/// -1 on the side of the `library`, the left one, 1 on that of the `gallery`.
double sideSign(const std::string& side);

/// The walls at some x or z.
Wall wallAtX(double x, bool facesRight);
Wall wallAtZ(double z, bool facesViewer);
/// A span along a wall, for either direction of its s.
Rectangle span(const Wall& wall, double from, double to, double bottom, double top);

void append(std::vector<Group>& groups, const std::vector<Group>& more);

// The hall (gallery_hall.cpp).

/// The wall above the columns of one side, bay by bay, with its arches, and the half piers at its ends.
void addArcade(std::vector<Group>& groups, const std::string& side);
/// A column on a square plinth, with a swelling shaft, under an abacus that the arcade's wall stands on.
void addColumn(std::vector<Group>& groups, const std::string& name, double x, double z);
/// The vault of each bay between the ribs, the ledges below it, and its ends.
void addVault(std::vector<Group>& groups);
/// A beam from wall to wall with a globe hanging from it.
void addTieBeam(std::vector<Group>& groups, const std::string& name, double z);
/// The wall opposite the apse with a door of two leaves.
void addDoor(std::vector<Group>& groups);

// The apse (gallery_apse.cpp).

/// The end wall with the arch, and the apse with three windows of coloured glass.
void addApse(std::vector<Group>& groups);
/// Three risers up to the landing, which has holes for the objects on it.
void addSteps(std::vector<Group>& groups, const std::vector<Rectangle>& holes);

// The round room (gallery_rotunda.cpp).

/// The room with its dome, its vase and the portal to it.
void addRotunda(std::vector<Group>& groups);
double portalHalfWidth();

// The aisles (gallery_aisles.cpp).

/// The aisle's ceiling, with a coffer in each bay, lit in the gallery.
void addCeiling(std::vector<Group>& groups, const std::string& side, const std::string& cofferMaterial);
void addLibraryWalls(std::vector<Group>& groups);
void addGalleryWalls(std::vector<Group>& groups);
/// The niches of the library's bookcases, on its outer wall.
std::vector<Rectangle> bookNiches();
Wall libraryWall();

}  // namespace hemitex::data
