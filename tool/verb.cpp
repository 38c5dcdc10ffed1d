// SPDX-License-Identifier: Apache-2.0
#include "tool/verb.h"

namespace limber::tool {
namespace {

constexpr Verb kVerbs[] = {
    {"build", "Turn a clip into a stream of all its levels of detail",
     "limber build 'horse/%04d.obj' -o horse.limber\n"
     "limber build horse.pc2 --mesh horse.obj --levels 3200,800 -o horse.limber\n"
     "limber build 'sample:gallop?vertices=5000&frames=24' --lossless -o gallop.limber\n",
     declare_build},
    {"info", "Say what is in a stream",
     "limber info horse.limber\n"
     "limber info horse.limber --frames --json\n",
     declare_info},
    {"check", "Test a stream, and every invariant of every frame",
     "limber check horse.limber\n"
     "limber check horse.limber --all --against 'horse/%04d.obj'\n",
     declare_check},
    {"play", "Run through a stream and report the time of each step",
     "limber play horse.limber\n"
     "limber play horse.limber --vertices 2000 --repeat 5 --json\n",
     declare_play},
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
