// SPDX-License-Identifier: Apache-2.0
// One per method; methods.cpp makes the table of them.
#pragma once

#include <memory>

#include "eval/methods/method.h"

namespace limber::eval {

std::unique_ptr<Method> make_direct(const MethodOptions& options);
std::unique_ptr<Method> make_improved(const MethodOptions& options);
std::unique_ptr<Method> make_first_frame(const MethodOptions& options);
std::unique_ptr<Method> make_multilevel(const MethodOptions& options);
std::unique_ptr<Method> make_feature(const MethodOptions& options);

}  // namespace limber::eval
