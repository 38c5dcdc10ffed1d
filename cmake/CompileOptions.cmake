# SPDX-License-Identifier: Apache-2.0
# What every target of the project is compiled with. Contraction of floating point expressions is off, so that
# g++ and clang give the same bytes.
function(limber_compile_options target)
  target_compile_options(${target} PRIVATE -ffp-contract=off -Wall -Wextra -Wshadow -Wconversion)
  if(LIMBER_WERROR)
    target_compile_options(${target} PRIVATE -Werror)
  endif()
endfunction()
