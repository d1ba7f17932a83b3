//! Names of many pictures: `frames/{frame:04}.png`.

use std::path::PathBuf;
use std::str::FromStr;

/// A name with places to be filled.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Template(Vec<Part>);

#[derive(Clone, Debug, PartialEq, Eq)]
enum Part {
    Text(String),
    /// With so many digits at least.
    Frame(usize),
    Model,
}

impl Template {
    /// The name of a picture.
    pub(crate) fn fill(&self, model: &str, frame: u32) -> PathBuf {
        let part = |part: &Part| match part {
            Part::Text(text) => text.clone(),
            Part::Frame(digits) => format!("{frame:0digits$}"),
            Part::Model => model.to_owned(),
        };
        self.0.iter().map(part).collect::<String>().into()
    }
}

impl FromStr for Template {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        const MOST_DIGITS: usize = 20;
        let mut parts = Vec::new();
        let mut rest = text;
        while let Some((before, after)) = rest.split_once('{') {
            let (key, after) = after.split_once('}').ok_or("a `{` has no `}`")?;
            let digits = key.strip_prefix("frame:").and_then(|digits| digits.parse().ok());
            parts.push(Part::Text(before.to_owned()));
            parts.push(match key {
                "model" => Part::Model,
                "frame" => Part::Frame(1),
                _ => {
                    Part::Frame(digits.filter(|&digits| digits <= MOST_DIGITS).ok_or_else(|| {
                        format!("`{{{key}}}` is not known: {{frame}}, {{frame:04}} and {{model}} are")
                    })?)
                }
            });
            rest = after;
        }
        parts.push(Part::Text(rest.to_owned()));
        if parts.iter().any(|part| matches!(part, Part::Frame(_))) {
            Ok(Self(parts))
        } else {
            Err("all pictures would have this name: write {frame} or {frame:04} where their number belongs".to_owned())
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_frames() {
        let name = |text: &str| text.parse::<Template>().unwrap().fill("cup", 7).display().to_string();
        assert_eq!(name("f/{frame:04}.png"), "f/0007.png");
        assert_eq!(name("{model}-{frame}.{frame:2}"), "cup-7.07");
        for bad in ["a.png", "{model}.png", "{frame", "{frame:}", "{frame:x}", "{frame:999}", "{camera}{frame}"] {
            assert!(bad.parse::<Template>().is_err(), "{bad}");
        }
    }
}
