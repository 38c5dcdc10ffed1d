// SPDX-License-Identifier: Apache-2.0
#include "tool/verb.h"

#include <array>

namespace limber::tool {
namespace {

constexpr Verb kVerbs[] = {
    {"convert", "Write a clip in another format",
     "limber convert 'horse/%04d.obj' -o horse.pc2\n"
     "limber convert horse.limber --first 10 --last 20 -o 'frames/%04d.ply'\n",
     declare_convert},
    {"sample", "Write one of the generated clips, or list them",
     "limber sample\n"
     "limber sample gallop --vertices 20000 --frames 60 -o 'gallop/%04d.obj'\n",
     declare_sample},
};

}  // namespace

std::span<const Verb> verbs() { return kVerbs; }

}  // namespace limber::tool
