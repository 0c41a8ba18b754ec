//! Not a file of the template: it has no effect.
