//! What is promised of figures.
