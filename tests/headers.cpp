// SPDX-License-Identifier: Apache-2.0
// Compiles the headers that all tests start with, once (CMakeLists.txt).
