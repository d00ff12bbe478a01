#define LASCAUX_KERNEL BaselineKernel
#include "block_kernel.inc"
