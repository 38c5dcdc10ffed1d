// SPDX-License-Identifier: Apache-2.0
// Which peers there are is told by the build: LIMBER_MESHOPTIMIZER, LIMBER_CGAL (their versions) and LIMBER_CGAL_EIGEN.
#include "eval/peers/peers.h"

#include <vector>

#include "eval/peers/factories.h"
#include "eval/peers/oriented_manifold.h"

namespace limber::eval {

std::span<const MethodInfo> peers() {
  static const std::vector<MethodInfo> all = {
#ifdef LIMBER_MESHOPTIMIZER
      {"meshoptimizer", "every frame by itself, to vertices that it has (meshoptimizer " LIMBER_MESHOPTIMIZER ")", true,
       Sees::kFirst, make_meshoptimizer, true},
#endif
#ifdef LIMBER_CGAL_EIGEN
      {"cgal-garland-heckbert", "every frame by itself, by plane quadrics (CGAL " LIMBER_CGAL ")", true, Sees::kFirst,
       make_cgal_garland_heckbert, true, check_oriented_manifold},
#endif
#ifdef LIMBER_CGAL
      {"cgal-lindstrom-turk", "every frame by itself, memoryless, keeping volumes (CGAL " LIMBER_CGAL ")", true,
       Sees::kFirst, make_cgal_lindstrom_turk, true, check_oriented_manifold},
#endif
  };
  return all;
}

std::string_view package_of_peer(std::string_view name) {
  if (name == "meshoptimizer") return "meshoptimizer (Debian: libmeshoptimizer-dev)";
  if (name == "cgal-garland-heckbert") return "CGAL and Eigen (Debian: libcgal-dev, libeigen3-dev)";
  if (name == "cgal-lindstrom-turk") return "CGAL (Debian: libcgal-dev)";
  return {};
}

}  // namespace limber::eval
