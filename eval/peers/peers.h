// SPDX-License-Identifier: Apache-2.0
// Simplifiers of other projects, each frame by itself, where limber was built with them (LIMBER_PEERS).
//
// The time of a frame is that of the peer's own work: making its structures of our mesh, and where it only takes a
// number of triangles, the search for the one that leaves so many vertices, are not counted. They keep to rules of
// topology of their own.
#pragma once

#include <span>
#include <string_view>

#include "eval/methods/method.h"

namespace limber::eval {

// The peers that there are, in the order in which a help text lists them.
std::span<const MethodInfo> peers();

// What has to be installed before limber is configured so that there is a peer of this name: "" for other names.
std::string_view package_of_peer(std::string_view name);

}  // namespace limber::eval
