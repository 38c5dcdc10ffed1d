// SPDX-License-Identifier: Apache-2.0
// One per peer; peers.cpp makes the table of those that there are.
#pragma once

#include <memory>

#include "eval/methods/method.h"

namespace limber::eval {

std::unique_ptr<Method> make_meshoptimizer(const MethodOptions& options);
std::unique_ptr<Method> make_cgal_garland_heckbert(const MethodOptions& options);
std::unique_ptr<Method> make_cgal_lindstrom_turk(const MethodOptions& options);

}  // namespace limber::eval
