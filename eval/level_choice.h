// SPDX-License-Identifier: Apache-2.0
// Which level of detail of a stream.
#pragma once

#include <optional>

#include "limber/view/cut.h"
#include "limber/view/view.h"

namespace limber::eval {

struct LevelChoice {
  std::optional<CutOptions> cut;     // nothing: the finest level
  std::optional<limber::View> view;  // how it is looked at
  Index blend = 0;                   // over how many frames a change is blended (limber/view/blend.h)
};

}  // namespace limber::eval
