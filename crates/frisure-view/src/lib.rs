//! Interactive pictures of hair on a GPU.
