//! `view.html`: its contents, and what it shows in a browser.

mod browser;
mod page;
mod shown;
