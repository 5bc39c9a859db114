// SPDX-License-Identifier: Apache-2.0
/// Loops that the compiler vectorises, compiled for several instruction sets; the loader selects the best one that the
/// processor supports. Every operation is rounded separately and in the order written, so that results do not depend
/// on the set. Use it on free functions (not members or lambdas) whose output is `__restrict`.
#pragma once

#if defined(__x86_64__) && defined(__gnu_linux__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define TALUS_CLONES [[gnu::target_clones("avx512f", "avx2", "default")]]
#else
#define TALUS_CLONES
#endif
