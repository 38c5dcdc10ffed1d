# SPDX-License-Identifier: Apache-2.0
# What every target of the project is compiled with. Contraction of floating point expressions is off, so that
# g++ and clang give the same bytes. Options are aggregates that callers set by name, and in part.
function(limber_compile_options target)
  target_compile_options(${target} PRIVATE -ffp-contract=off -Wall -Wextra -Wshadow -Wconversion
                                           -Wno-missing-field-initializers)
  if(LIMBER_WERROR)
    target_compile_options(${target} PRIVATE -Werror)
  endif()
endfunction()
