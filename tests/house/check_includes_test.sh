#!/bin/sh
# Proves that scripts/check-includes can fail: a small tree that keeps the rules, then each rule broken once.
# SPDX-License-Identifier: Apache-2.0
set -eu
check=$1/scripts/check-includes
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT INT TERM
failures=0

sound_tree() {
  rm -rf "$work/src"
  mkdir -p "$work/src/limber/base" "$work/src/limber/clip" "$work/src/limber/hierarchy" "$work/src/limber/stream"
  cd "$work/src/limber"
  printf '#include <cmath>\n' >base/vec.h
  printf '#include <filesystem>\n#include "limber/base/vec.h"\n' >clip/clip.h
  printf '#include "limber/base/vec.h"\n' >hierarchy/hierarchy.h
  printf '#include <tbb/parallel_for.h>\n#include "limber/clip/clip.h"\n' >hierarchy/build.h
  printf '#include <vector>\n#include "limber/hierarchy/hierarchy.h"\n#include "limber/version.h"\n' >stream/decode.h
  printf '#include "limber/stream/decode.h"\n' >stream/decode.cpp
  printf '#include "limber/hierarchy/build.h"\n' >stream/encode.h
  printf '#include "limber/stream/encode.h"\n' >stream/encode.cpp
  printf 'target_sources(limber PRIVATE encode.cpp)\ntarget_sources(limber_player PRIVATE\n  decode.cpp)\n' >stream/CMakeLists.txt
}

# refused "SITUATION" "PART OF THE MESSAGE": the tree as it stands now breaks a rule
refused() {
  if said=$("$check" "$work" 2>&1); then
    echo "FAILED: accepted $1"
    failures=$((failures + 1))
  else
    case $said in
      *"$2"*) echo "ok: refuses $1" ;;
      *) echo "FAILED: refuses $1, but says: $said"; failures=$((failures + 1)) ;;
    esac
  fi
}

sound_tree
"$check" "$work" || { echo "FAILED: refused a tree that keeps the rules"; failures=$((failures + 1)); }
[ "$("$check" --player "$work" | tr '\n' ' ')" = "limber/base/vec.h limber/hierarchy/hierarchy.h limber/stream/decode.cpp limber/stream/decode.h " ] ||
  { echo "FAILED: the player's files are not those listed and reached"; failures=$((failures + 1)); }

sound_tree; echo '  #  include "limber/stream/decode.h"' >>clip/clip.h
refused "a folder that includes from a later one" "limber/clip/clip.h:3: clip/ may not include from stream/"

sound_tree; echo '#include "vec.h"' >base/box.h
refused "an include without the full path" 'limber/base/box.h:1: "vec.h" is no header'

sound_tree; echo '#include "limber/base/gone.h"' >>clip/clip.h
refused "an include of a header that is not there" '"limber/base/gone.h" is no header'

sound_tree; echo '#include <fmt/core.h>' >>stream/decode.cpp
refused "a player's file that includes another library" "limber/stream/decode.cpp:2: the player may not include <fmt/core.h>"

sound_tree; echo '#include <fstream>' >>base/vec.h
refused "a header that the player reaches and that needs files" "limber/base/vec.h:2: the player may not include <fstream>"

sound_tree; echo '#include "limber/clip/clip.h"' >>stream/decode.h
refused "a player's file that includes from the building side" "limber/stream/decode.h:4: the player may not include limber/clip/clip.h"

sound_tree; echo '#include "limber/hierarchy/build.h"' >>stream/decode.cpp
refused "a player's file that includes the builder of hierarchies" "may not include limber/hierarchy/build.h"

sound_tree; printf '#include "limber/base/vec.h"\n' >stream/encode.h; echo '#include "limber/stream/encode.h"' >>stream/decode.cpp
refused "a player's file that needs a source outside the player" "limber/stream/encode.cpp is not in limber_player"

sound_tree; rm stream/decode.cpp
refused "a list that names a file that is not there" "limber/stream/decode.cpp: listed for limber_player"

[ "$failures" = 0 ]
