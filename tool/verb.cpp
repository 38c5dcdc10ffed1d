// SPDX-License-Identifier: Apache-2.0
#include "tool/verb.h"

#include <array>

namespace limber::tool {
namespace {

constexpr Verb kVerbs[] = {
    {"extract", "Take a level of detail out of a stream, as a mesh or a picture",
     "limber extract horse.limber --frame 12 --vertices 800 -o horse12.ply\n"
     "limber extract horse.limber --triangles 2000 -o 'lod/%04d.obj'\n"
     "limber extract horse.limber --frame 12 --error 0.1 --wireframe --view side -o horse12.png\n"
     "limber extract horse.limber --frame 12 --vertices 800 --side-by-side --error-colors -o horse12.png\n",
     declare_extract},
    {"simplify", "Simplify a clip or mesh by any method, and measure the result",
     "limber simplify bunny.ply --method direct --ratio 0.1 -o bunny10.ply\n"
     "limber simplify 'horse/%04d.obj' --method multilevel --vertices 800 -o 'out/%04d.obj'\n"
     "limber simplify 'horse/%04d.obj' --method direct,first-frame,multilevel --vertices 800 --measure\n",
     declare_simplify},
    {"measure", "Measure how far an approximation is from its original, and how much it flickers",
     "limber measure bunny.ply bunny10.ply\n"
     "limber measure 'horse/%04d.obj' 'out/%04d.obj' --json\n"
     "limber measure 'horse/%04d.obj' horse.limber --vertices 800\n",
     declare_measure},
    {"render", "Take pictures of a mesh or clip",
     "limber render 'horse/%04d.obj' --frame 12 -o horse12.png\n"
     "limber render cloth.pc2 --flat --view 60,20 --size 1920x1080 -o 'cloth/%04d.png'\n"
     "limber render bunny10.ply --error-colors --original bunny.ply -o bunny10.png\n",
     declare_render},
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
