//! `view.html`: its contents, and what it shows in a browser.

mod browser;
mod film;
mod page;
mod shown;
