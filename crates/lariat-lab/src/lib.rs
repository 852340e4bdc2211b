//! Scene files, headless runs and reports for Lariat cables.
