//! The salon.
