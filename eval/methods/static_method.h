// SPDX-License-Identifier: Apache-2.0
// Methods that differ only in how they contract: one clustering for the whole clip, placed anew in every frame.
#pragma once

#include <functional>
#include <memory>
#include <span>

#include "eval/methods/method.h"

namespace limber::eval {

// A contractor before its first contraction, from what Method::begin() is given.
using MakeContractor =
    std::function<Contractor(const Mesh& mesh, std::span<const std::span<const Vec3f>> seen, const ContractOptions&)>;

//   begin:  make the contractor, and contract to the size asked for
//   frame:  place the clusters (static_clusters.h)
std::unique_ptr<Method> make_static_method(const MethodOptions& options, MakeContractor make_contractor);

}  // namespace limber::eval
