/// Parsers of mesh formats, one source each. OBJ files have a header of their own (obj_file.h).
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "radiosity/meshes/polygon_mesh.h"

namespace hemitex::radiosity {

/// PLY (ply_file.cpp). Parses the bytes of `file`. All faces are of one group; other elements and properties are
/// skipped. Throws InputError for malformed headers, a file without vertices or faces, indices out of range, and a file
/// that ends too early.
PolygonMesh parsePly(std::string_view bytes, const std::filesystem::path& file);

/// STL (stl_file.cpp). Parses the bytes of `file`. They are a text if the first word is `solid` or `facet` and no NUL
/// byte follows soon, else binary. Each `solid` of a text is a group. The order of vertices says which side is the
/// front; a normal that contradicts it is a warning, and one that is no number says nothing. Warns of colours of facets
/// and of bytes behind the last triangle, which are left out. Throws InputError, with the line of a text, for anything
/// else.
PolygonMesh parseStl(std::string_view bytes, const std::filesystem::path& file);

/// View3D (vs3_file.cpp). Parses the text of `file`. Each surface and each obstruction is a face; its group is the
/// surface's name. The mesh has the array `reflectance`: 1 less the emittance of a surface, and 0 for obstructions.
/// View3D adds up surfaces that it combines; here they stay faces of their own, with a warning. Throws InputError with
/// the line for other formats, masks, surfaces inside of others, numbers out of sequence and indices out of range.
PolygonMesh parseVs3(std::string_view text, const std::filesystem::path& file);

/// VTK's legacy files (legacy_vtk_file.cpp). Parses points and cells of `file`, and the cell data of the given names;
/// other data are ignored. Throws InputError for other data sets, cells that are no faces (see vtk_cells.h), cell data
/// that are missing, and malformed files.
PolygonMesh parseLegacyVtk(std::string_view bytes, const std::filesystem::path& file,
                           std::span<const std::string> cellData = {});

/// VTK's XML files (vtk_xml_file.cpp). Parses points and cells of `file`, of all its pieces, and the cell data of the
/// given names. Other arrays are ignored. Throws InputError for other kinds of data, cells that are no faces (see
/// vtk_cells.h), other compression than zlib, cell data that are missing, and malformed files.
PolygonMesh parseVtkXml(std::string_view bytes, const std::filesystem::path& file,
                        std::span<const std::string> cellData = {});

}  // namespace hemitex::radiosity
