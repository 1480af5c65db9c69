//! Plain V/W.
