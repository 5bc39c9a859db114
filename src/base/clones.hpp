// SPDX-License-Identifier: Apache-2.0
/// Loops that the compiler turns into vectors by itself, compiled for several instruction sets at once; the loader
/// takes the best that the processor has. They round every operation by itself and in the order written, so that the
/// set makes no difference to the bits. Before a function of its own, outside of a class and not a lambda, whose output
/// is `__restrict`.
#pragma once

#if defined(__x86_64__) && defined(__gnu_linux__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define TALUS_CLONES [[gnu::target_clones("avx512f", "avx2", "default")]]
#else
#define TALUS_CLONES
#endif
