// SPDX-License-Identifier: Apache-2.0
// Linked with every object of limber_player and nothing but the C++ standard library: if the player needed
// anything else, this program would not link.
#include "limber/version.h"

int main() { return limber::kVersion[0] == '\0'; }
