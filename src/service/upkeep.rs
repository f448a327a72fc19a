//! What is done every now and then.
