//! Linear algebra of a cable: symmetric block-tridiagonal matrices with 6x6 blocks.
