//! The force strategy of a cable: an axial rule and a bending rule, named as the paper names them.
//!
//! | name | axial | bending | note |
//! |---|---|---|---|
//! | `projected-3` | projected strain | 3 Gauss points | default: neither locks nor has spare modes |
//! | `G5-3`, `G10-10` | Gauss, L points | Gauss, T points | the paper's GL-T |
//! | `ST2` | exact | T2 | the paper's symbolic model |
//! | `L2T2` | mean strain | T2 | the paper's simplified model |
//! | `exact-3`, `mean-T1`, `G5-none` ... | any | any | free choice |

use crate::element::axial::{self, AxialTable};
use crate::error::{Error, nearest};
pub use crate::scales::element::MAX_POINTS;
use serde::{Deserialize, Serialize};
use std::fmt;
use std::str::FromStr;

/// How the axial energy is integrated; see [`axial`](crate::element::axial).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(into = "String", try_from = "String")]
pub enum AxialRule {
    /// Green strain projected on linear functions.
    Projected,
    /// Exact integral.
    Exact,
    /// Mean Green strain (L2).
    Mean,
    /// Gauss quadrature with this many points, 1 to 10.
    Gauss(u8),
}

/// How the bending energy is integrated; see [`bending`](crate::element::bending).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(into = "String", try_from = "String")]
pub enum BendingRule {
    /// No bending stiffness.
    None,
    /// Mean of |r''|^2.
    T1,
    /// T1 with the mean stretch divided out.
    T2,
    /// Gauss quadrature of the full curvature with this many points, 1 to 10.
    Gauss(u8),
}

/// An axial rule and a bending rule.
///
/// ```
/// use lariat_ancf::{AxialRule, BendingRule, Rule};
/// assert_eq!("G5-3".parse::<Rule>()?, Rule::new(AxialRule::Gauss(5), BendingRule::Gauss(3)));
/// assert_eq!(Rule::ST2.to_string(), "ST2");
/// assert!("G2-2".parse::<Rule>()?.check().is_err()); // a mode without energy
/// # Ok::<(), lariat_ancf::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(into = "String", try_from = "String")]
pub struct Rule {
    /// The axial rule.
    pub axial: AxialRule,
    /// The bending rule.
    pub bending: BendingRule,
}

impl Default for Rule {
    /// `projected-3`.
    fn default() -> Self {
        Rule::new(AxialRule::Projected, BendingRule::Gauss(3))
    }
}

impl Rule {
    /// The paper's ST2: exact axial energy, bending T2.
    pub const ST2: Rule = Rule::new(AxialRule::Exact, BendingRule::T2);
    /// The paper's L2T2: mean Green strain, bending T2.
    pub const L2T2: Rule = Rule::new(AxialRule::Mean, BendingRule::T2);

    /// A free choice.
    pub const fn new(axial: AxialRule, bending: BendingRule) -> Self {
        Rule { axial, bending }
    }

    /// The paper's G*L*-*T*: Gauss quadrature with `longitudinal` and `transverse` points, 1 to 10
    /// each.
    ///
    /// # Errors
    /// [`Error::UnknownRule`] if a number of points is out of range.
    pub fn gauss(longitudinal: u8, transverse: u8) -> Result<Self, Error> {
        format!("G{longitudinal}-{transverse}").parse()
    }

    /// Refuses a pair of rules that leaves modes of deformation without energy.
    ///
    /// # Errors
    /// [`Error::RankDeficient`] with the reason.
    /// [`CableBuilder::allow_rank_deficient`](crate::CableBuilder::allow_rank_deficient) builds
    /// such a cable all the same.
    pub fn check(self) -> Result<(), Error> {
        self.check_points()?;
        self.spare_modes().map_or(Ok(()), |reason| Err(Error::RankDeficient { rule: self.to_string(), reason }))
    }

    /// Refuses a number of Gauss points that is out of range.
    ///
    /// # Errors
    /// [`Error::UnknownRule`].
    pub(crate) fn check_points(self) -> Result<(), Error> {
        let range = 1..=MAX_POINTS;
        let axial = matches!(self.axial, AxialRule::Gauss(n) if !range.contains(&n));
        let bending = matches!(self.bending, BendingRule::Gauss(n) if !range.contains(&n));
        if axial || bending {
            let (rule, expected) = (self.to_string(), "1 to 10 Gauss points");
            return Err(Error::UnknownRule { rule, expected, suggestion: None });
        }
        Ok(())
    }

    /// Why the pair leaves modes of deformation without energy, if it does.
    pub fn spare_modes(self) -> Option<&'static str> {
        let slope_held_by_bending = matches!(self.bending, BendingRule::T1 | BendingRule::T2);
        match (self.axial, self.bending) {
            (_, BendingRule::Gauss(1)) => {
                Some("one bending point per element leaves one bending mode per element and direction without energy")
            }
            _ if slope_held_by_bending => None,
            (AxialRule::Mean | AxialRule::Gauss(1), _) => Some(
                "one strain per element leaves the stretch free to vary inside it; combine it with bending T1 or T2, \
                 or use the projected or exact axial rule",
            ),
            (AxialRule::Gauss(2), _) => Some(
                "two axial points leave a global mode in which all |r'| drift together; use 3 points or more, \
                 the projected rule, or bending T1 or T2",
            ),
            _ => None,
        }
    }

    /// Numbers of the axial rule.
    pub fn axial_table(self) -> AxialTable {
        match self.axial {
            AxialRule::Projected => axial::projected::table(),
            AxialRule::Exact => axial::exact::table(),
            AxialRule::Mean => axial::mean::table(),
            AxialRule::Gauss(points) => axial::gauss::table(points as usize),
        }
    }
}

impl fmt::Display for AxialRule {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            AxialRule::Projected => f.write_str("projected"),
            AxialRule::Exact => f.write_str("exact"),
            AxialRule::Mean => f.write_str("mean"),
            AxialRule::Gauss(points) => write!(f, "gauss-{points}"),
        }
    }
}

impl fmt::Display for BendingRule {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            BendingRule::None => f.write_str("none"),
            BendingRule::T1 => f.write_str("t1"),
            BendingRule::T2 => f.write_str("t2"),
            BendingRule::Gauss(points) => write!(f, "gauss-{points}"),
        }
    }
}

impl fmt::Display for Rule {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let bending = match self.bending {
            BendingRule::None => "none".to_string(),
            BendingRule::T1 => "T1".to_string(),
            BendingRule::T2 => "T2".to_string(),
            BendingRule::Gauss(points) => points.to_string(),
        };
        match (self.axial, self.bending) {
            (AxialRule::Exact, BendingRule::T1 | BendingRule::T2) => write!(f, "S{bending}"),
            (AxialRule::Mean, BendingRule::T1 | BendingRule::T2) => write!(f, "L2{bending}"),
            (AxialRule::Gauss(points), _) => write!(f, "G{points}-{bending}"),
            (axial, _) => write!(f, "{axial}-{bending}"),
        }
    }
}

fn unknown(text: &str, expected: &'static str, names: impl IntoIterator<Item = String>) -> Error {
    Error::UnknownRule { rule: text.to_string(), expected, suggestion: nearest(text, names) }
}

/// Every axial rule.
fn axial_rules() -> impl Iterator<Item = AxialRule> {
    let named = [AxialRule::Projected, AxialRule::Exact, AxialRule::Mean];
    named.into_iter().chain((1..=MAX_POINTS).map(AxialRule::Gauss))
}

/// Every bending rule.
fn bending_rules() -> impl Iterator<Item = BendingRule> + Clone {
    let named = [BendingRule::None, BendingRule::T1, BendingRule::T2];
    named.into_iter().chain((1..=MAX_POINTS).map(BendingRule::Gauss))
}

/// Every pair of an axial and a bending rule.
fn rules() -> impl Iterator<Item = Rule> {
    axial_rules().flat_map(|axial| bending_rules().map(move |bending| Rule::new(axial, bending)))
}

fn points(text: &str) -> Option<u8> {
    text.parse().ok().filter(|n| (1..=MAX_POINTS).contains(n))
}

impl FromStr for AxialRule {
    type Err = Error;
    fn from_str(text: &str) -> Result<Self, Error> {
        let lower = text.to_ascii_lowercase();
        match lower.as_str() {
            "projected" => Ok(AxialRule::Projected),
            "exact" => Ok(AxialRule::Exact),
            "mean" => Ok(AxialRule::Mean),
            _ => lower
                .strip_prefix("gauss-")
                .or_else(|| lower.strip_prefix('g'))
                .and_then(points)
                .map(AxialRule::Gauss)
                .ok_or_else(|| {
                    let expected = "projected | exact | mean | gauss-N, N from 1 to 10";
                    unknown(text, expected, axial_rules().map(String::from))
                }),
        }
    }
}

impl FromStr for BendingRule {
    type Err = Error;
    fn from_str(text: &str) -> Result<Self, Error> {
        let lower = text.to_ascii_lowercase();
        match lower.as_str() {
            "none" => Ok(BendingRule::None),
            "t1" => Ok(BendingRule::T1),
            "t2" => Ok(BendingRule::T2),
            _ => points(lower.strip_prefix("gauss-").unwrap_or(&lower)).map(BendingRule::Gauss).ok_or_else(|| {
                let expected = "none | t1 | t2 | gauss-N, N from 1 to 10";
                unknown(text, expected, bending_rules().map(String::from))
            }),
        }
    }
}

impl FromStr for Rule {
    type Err = Error;
    fn from_str(text: &str) -> Result<Self, Error> {
        const EXPECTED: &str = "GL-T (L, T from 1 to 10) | ST1 | ST2 | L2T1 | L2T2 | AXIAL-BENDING, \
             AXIAL = projected, exact, mean, GL; BENDING = none, T1, T2, 1 to 10";
        let upper = text.to_ascii_uppercase();
        if let Some(bending @ ("T1" | "T2")) = upper.strip_prefix('S') {
            return Ok(Rule::new(AxialRule::Exact, bending.parse()?));
        }
        if let Some(bending @ ("T1" | "T2")) = upper.strip_prefix("L2") {
            return Ok(Rule::new(AxialRule::Mean, bending.parse()?));
        }
        let parts = text.split_once('-').and_then(|(a, b)| Some(Rule::new(a.parse().ok()?, b.parse().ok()?)));
        parts.ok_or_else(|| unknown(text, EXPECTED, rules().map(String::from)))
    }
}

macro_rules! as_text {
    ($($name:ty),*) => {$(
        impl From<$name> for String {
            fn from(value: $name) -> String { value.to_string() }
        }
        impl TryFrom<String> for $name {
            type Error = Error;
            fn try_from(text: String) -> Result<Self, Error> { text.parse() }
        }
    )*};
}
as_text!(AxialRule, BendingRule, Rule);

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_rule_reads_back_as_printed() {
        for rule in rules() {
            let Rule { axial, bending } = rule;
            assert_eq!(rule.to_string().parse::<Rule>().unwrap(), rule);
            assert_eq!(axial.to_string().parse::<AxialRule>().unwrap(), axial);
            assert_eq!(bending.to_string().parse::<BendingRule>().unwrap(), bending);
        }
        for name in ["G2-2", "G10-10", "ST2", "L2T2", "projected-3", "G5-none"] {
            assert_eq!(name.parse::<Rule>().unwrap().to_string(), name);
        }
    }

    #[test]
    fn an_unknown_rule_is_an_error_that_shows_it_and_what_is_accepted() {
        for text in ["", "G0-3", "G11-3", "G5-11", "G5", "ST3", "L1T2", "G5-3-1", "gauss", "exact-0"] {
            let error = text.parse::<Rule>().unwrap_err().to_string();
            assert!(error.contains(&format!("{text:?}")) && error.contains("ST2"), "{error}");
        }
    }
}
