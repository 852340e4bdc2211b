//! `view.html`: what it holds, and, in a browser, what it shows.

mod browser;
mod page;
mod shown;
