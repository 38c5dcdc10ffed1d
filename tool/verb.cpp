// SPDX-License-Identifier: Apache-2.0
#include "tool/verb.h"

namespace limber::tool {
namespace {

constexpr Verb kVerbs[] = {
    {"build", "Turn a clip into a stream of all its levels of detail",
     "limber build 'horse/%04d.obj' -o horse.limber\n"
     "limber build horse.pc2 --mesh horse.obj --levels 3200,800 -o horse.limber\n"
     "limber build 'sample:gallop?vertices=5000&frames=24' --lossless -o gallop.limber\n"
     "limber build bunny.obj --structure four-face -o bunny.limber\n",
     declare_build},
    {"info", "Say what is in a stream",
     "limber info horse.limber\n"
     "limber info horse.limber --frames --json\n",
     declare_info},
    {"extract", "Take a level of detail out of a stream, as a mesh or a picture",
     "limber extract horse.limber --frame 12 --vertices 800 -o horse12.ply\n"
     "limber extract horse.limber --triangles 2000 -o 'lod/%04d.obj'\n"
     "limber extract horse.limber --frame 12 --error 0.1 --wireframe --view side -o horse12.png\n"
     "limber extract bunny.limber --eye 0,0,9 --target 0,0,0 --pixels 2 -o bunny.ply\n"
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
    {"compare", "Compare all methods on a clip, in a report to look at",
     "limber compare 'horse/%04d.obj' --vertices 800 -o report/\n"
     "limber compare cloth.pc2 --ratio 0.05 --method direct,first-frame,multilevel --view 60,20 -o report/\n"
     "limber compare 'horse/%04d.obj' --vertices 800 --sweep unified=1,0.96,0.8 --part ear=0.07,1.33,0.56,0.07 -o "
     "report/\n",
     declare_compare},
    {"check", "Test a stream, and every invariant of every frame",
     "limber check horse.limber\n"
     "limber check horse.limber --all --against 'horse/%04d.obj'\n",
     declare_check},
    {"play", "Run through a stream and report the time of each step",
     "limber play horse.limber\n"
     "limber play horse.limber --vertices 2000 --repeat 5 --json\n"
     "limber play horse.limber --repeat 40 -o update.svg\n",
     declare_play},
    {"view", "Look at a stream in the browser",
     "limber view horse.limber\n"
     "limber view horse.limber --no-open --port 8080\n"
     "limber view horse.limber --export horse.html\n",
     declare_view},
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
