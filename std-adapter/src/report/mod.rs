//! Tables, CSV and JSON from what studies found.
