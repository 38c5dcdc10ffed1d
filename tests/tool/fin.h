// SPDX-License-Identifier: Apache-2.0
// A mesh that is not a manifold, as text.
#pragma once

#include <string>

namespace limber::test {

// A bumpy square of 8 x 8 squares as OBJ, with one triangle more that stands on an inner edge, between the vertices 40
// and 41 (from 0). 82 vertices.
inline std::string square_with_a_fin() {
  std::string obj;
  for (int i = 0; i < 9; ++i) {
    for (int j = 0; j < 9; ++j)
      obj += "v " + std::to_string(j) + " " + std::to_string(i) + " " + std::to_string((i * j + i) % 5) + "\n";
  }
  obj += "v 4.5 4 9\n";
  const auto face = [&](int a, int b, int c) {
    obj += "f " + std::to_string(a + 1) + " " + std::to_string(b + 1) + " " + std::to_string(c + 1) + "\n";
  };
  for (int i = 0; i < 8; ++i) {
    for (int j = 0; j < 8; ++j) {
      const int v = 9 * i + j;
      face(v, v + 1, v + 10);
      face(v, v + 10, v + 9);
    }
  }
  face(40, 41, 81);
  return obj;
}

}  // namespace limber::test
