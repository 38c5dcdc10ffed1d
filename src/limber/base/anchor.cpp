// SPDX-License-Identifier: Apache-2.0
#include "limber/base/vec.h"
