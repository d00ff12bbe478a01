#define LASCAUX_KERNEL Avx2Kernel
#include "block_kernel.inc"
