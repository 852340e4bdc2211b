//! Bounds of an XML text that are checked before it is parsed: the parser and what reads its tree call themselves for each
//! level, and compare each attribute of an element with the others.

/// Most levels of elements: a cable of MuJoCo is a chain of nested bodies only after its compilation, and a model that is
/// written by hand or exported has a level for each joint of an arm.
pub(super) const LEVELS: usize = 256;
/// Most attributes of an element: MuJoCo's own schema has at most 40.
const ATTRIBUTES: usize = 256;

/// Checks a text; a text that is no XML passes, and the parser tells what is wrong with it.
///
/// # Errors
/// The line, and what is too many there.
pub(super) fn check(text: &str) -> Result<(), (u32, String)> {
    let mut levels = 0_usize;
    let mut rest = text;
    let line = |rest: &str| text[..text.len() - rest.len()].matches('\n').count() as u32 + 1;
    while let Some(start) = rest.find('<') {
        rest = &rest[start..];
        let skipped = [("<!--", "-->"), ("<![CDATA[", "]]>"), ("<?", "?>"), ("<!", ">")];
        if let Some((open, close)) = skipped.iter().find(|(open, _)| rest.starts_with(open)) {
            let Some(end) = rest[open.len()..].find(close) else { return Ok(()) };
            rest = &rest[open.len() + end + close.len()..];
            continue;
        }
        let Some((end, attributes)) = tag(rest) else { return Ok(()) };
        if attributes > ATTRIBUTES {
            return Err((
                line(rest),
                format!("an element has {attributes} attributes; accepted: at most {ATTRIBUTES}"),
            ));
        }
        if rest.starts_with("</") {
            levels = levels.saturating_sub(1);
        } else if !rest[..end].ends_with('/') {
            levels += 1;
        }
        if levels > LEVELS {
            return Err((line(rest), format!("elements are nested deeper than {LEVELS} levels")));
        }
        rest = &rest[end + 1..];
    }
    Ok(())
}

/// Returns where a tag ends, and the number of its attributes; `None` if it does not end.
fn tag(text: &str) -> Option<(usize, usize)> {
    let (mut quote, mut attributes) = (None, 0);
    for (at, byte) in text.bytes().enumerate() {
        match (quote, byte) {
            (Some(open), _) if open == byte => quote = None,
            (Some(_), _) => {}
            (None, b'"' | b'\'') => quote = Some(byte),
            (None, b'=') => attributes += 1,
            (None, b'>') => return Some((at, attributes)),
            (None, _) => {}
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nested_elements_and_attributes_are_bounded_before_the_parser_sees_them() {
        let nested = |levels: usize| "<body>".repeat(levels) + &"</body>".repeat(levels);
        assert_eq!(check(&nested(LEVELS)), Ok(()));
        assert_eq!(check(&("<mujoco>\n".to_string() + &nested(10_000))).unwrap_err().0, 2);
        let attributes = |count: usize| {
            let list: String = (0..count).map(|i| format!(" a{i}='>'")).collect();
            format!("<body{list}/>")
        };
        assert_eq!(check(&attributes(ATTRIBUTES)), Ok(()));
        assert!(check(&attributes(100_000)).unwrap_err().1.contains("100000 attributes"));
    }

    #[test]
    fn comments_and_what_is_no_xml_count_nothing() {
        let comments = "<a><!-- <b><b> --><?x <b> ?><![CDATA[<b>]]></a>".repeat(LEVELS);
        assert_eq!(check(&comments), Ok(()));
        for text in ["", "<", "<a", "<!--", "</a></a>", "<a b='", "<\u{e9}/>"] {
            assert_eq!(check(text), Ok(()), "{text}");
        }
    }
}
