# SPDX-License-Identifier: Apache-2.0
"""The laboratory: ensembles, comparisons with references, reproductions of papers. Each command of the program of this name
is a module here, to which the program hands its options, checked."""
