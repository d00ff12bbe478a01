#pragma once

/// @file
/// Functions that take vectors are inlined everywhere: code for another instruction set would call
/// them in another way than they were compiled for.

#define LASCAUX_INLINE [[gnu::always_inline]] inline
/// For lambdas, behind their parameters.
#define LASCAUX_INLINED __attribute__((always_inline))
