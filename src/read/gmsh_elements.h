// The types of Gmsh's elements: what they are, and how many nodes each has.
//
// https://gmsh.info/doc/texinfo/gmsh.html#MSH-file-format
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <string_view>

namespace gaussmesh {

struct GmshElement {
  std::uint64_t type = 0;  ///< Gmsh's number
  std::string_view shape;
  int dimension = 0;
  std::size_t nodes = 0;
};

inline constexpr std::uint64_t kGmshTriangle = 2;

inline constexpr std::array<GmshElement, 33> kGmshElements = {{
    {1, "line", 1, 2},          {2, "triangle", 2, 3},      {3, "quadrangle", 2, 4},    {4, "tetrahedron", 3, 4},
    {5, "hexahedron", 3, 8},    {6, "prism", 3, 6},         {7, "pyramid", 3, 5},       {8, "line", 1, 3},
    {9, "triangle", 2, 6},      {10, "quadrangle", 2, 9},   {11, "tetrahedron", 3, 10}, {12, "hexahedron", 3, 27},
    {13, "prism", 3, 18},       {14, "pyramid", 3, 14},     {15, "point", 0, 1},        {16, "quadrangle", 2, 8},
    {17, "hexahedron", 3, 20},  {18, "prism", 3, 15},       {19, "pyramid", 3, 13},     {20, "triangle", 2, 9},
    {21, "triangle", 2, 10},    {22, "triangle", 2, 12},    {23, "triangle", 2, 15},    {24, "triangle", 2, 15},
    {25, "triangle", 2, 21},    {26, "line", 1, 4},         {27, "line", 1, 5},         {28, "line", 1, 6},
    {29, "tetrahedron", 3, 20}, {30, "tetrahedron", 3, 35}, {31, "tetrahedron", 3, 56}, {92, "hexahedron", 3, 64},
    {93, "hexahedron", 3, 125},
}};

/// What Gmsh documents of a type; nothing of the others.
inline const GmshElement* find_gmsh_element(std::uint64_t type) {
  const auto element = std::find_if(kGmshElements.begin(), kGmshElements.end(),
                                    [&](const GmshElement& known) { return known.type == type; });
  return element == kGmshElements.end() ? nullptr : &*element;
}

}  // namespace gaussmesh
