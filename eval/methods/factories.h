// SPDX-License-Identifier: Apache-2.0
// One per method; methods.cpp makes the table of them.
#pragma once

#include <memory>

#include "eval/methods/method.h"

namespace limber::eval {

std::unique_ptr<Method> make_direct(const MethodOptions& options);
std::unique_ptr<Method> make_direct_volume(const MethodOptions& options);
std::unique_ptr<Method> make_improved(const MethodOptions& options);
std::unique_ptr<Method> make_first_frame(const MethodOptions& options);
std::unique_ptr<Method> make_rest_pose(const MethodOptions& options);
std::unique_ptr<Method> make_four_face(const MethodOptions& options);
std::unique_ptr<Method> make_four_face_front(const MethodOptions& options);
std::unique_ptr<Method> make_dsd(const MethodOptions& options);
std::unique_ptr<Method> make_average(const MethodOptions& options);
std::unique_ptr<Method> make_pose_independent(const MethodOptions& options);
std::unique_ptr<Method> make_deformation_oriented(const MethodOptions& options);
std::unique_ptr<Method> make_best_cut(const MethodOptions& options);
std::unique_ptr<Method> make_multilevel(const MethodOptions& options);
std::unique_ptr<Method> make_feature(const MethodOptions& options);
std::unique_ptr<Method> make_t_dag(const MethodOptions& options);

}  // namespace limber::eval
