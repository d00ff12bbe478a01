#define LASCAUX_KERNEL Avx512Kernel
#include "block_kernel.inc"
