//! A moment, as RFC 3339 writes it: `2026-06-21T12:00:00Z`, `2026-06-21T14:00:00.5+02:00`.

/// Days of universal time since J2000.0, noon of 1 January 2000.
///
/// # Errors
/// What is wrong with the text. A time without offset is wrong: it would be a different one everywhere.
pub(super) fn days_since_j2000(text: &str) -> Result<f64, String> {
    let mut rest = Rest(text);
    let (year, month, day) = (rest.number(4)?, rest.after("-", 2)?, rest.after("-", 2)?);
    rest.one_of("Tt", "a `T` between the date and the time")?;
    let (hour, minute, second) = (rest.number(2)?, rest.after(":", 2)?, rest.after(":", 2)?);
    let fraction = rest.fraction()?;
    let offset = rest.offset()?;
    if !rest.0.is_empty() {
        return Err(format!("nothing may follow the offset, but `{}` does", rest.0));
    }
    within("month", month, 1, 12)?;
    within("day", day, 1, days_of_month(year, month))?;
    within("hour", hour, 0, 23)?;
    within("minute", minute, 0, 59)?;
    // A leap second is the 60th.
    within("second", second, 0, 60)?;
    let seconds = f64::from((hour * 60 + minute - offset) * 60 + second) + fraction;
    Ok(f64::from(day_number(year, month, day)) - 0.5 + seconds / 86_400.0)
}

/// What of the text is still to be read.
struct Rest<'a>(&'a str);

impl Rest<'_> {
    /// Exactly `digits` digits.
    fn number(&mut self, digits: usize) -> Result<i32, String> {
        let found = self.0.bytes().take(digits).take_while(u8::is_ascii_digit).count();
        if found < digits {
            return Err(format!("{digits} digits are missing at `{}`", self.0));
        }
        let (number, rest) = self.0.split_at(digits);
        self.0 = rest;
        number.parse().map_err(|_| format!("`{number}` is no number"))
    }

    fn one_of(&mut self, characters: &str, what: &str) -> Result<char, String> {
        let mut rest = self.0.chars();
        let first = rest.next().filter(|&c| characters.contains(c));
        let found = first.ok_or_else(|| format!("{what} is missing at `{}`", self.0))?;
        self.0 = rest.as_str();
        Ok(found)
    }

    fn after(&mut self, separator: &str, digits: usize) -> Result<i32, String> {
        self.one_of(separator, &format!("`{separator}`"))?;
        self.number(digits)
    }

    /// The part of a second after the point, if there is one.
    fn fraction(&mut self) -> Result<f64, String> {
        let Some(rest) = self.0.strip_prefix('.') else {
            return Ok(0.0);
        };
        let digits = rest.bytes().take_while(u8::is_ascii_digit).count();
        if digits == 0 {
            return Err(format!("digits are missing at `{rest}`"));
        }
        let (fraction, rest) = rest.split_at(digits);
        self.0 = rest;
        Ok(fraction.bytes().rev().fold(0.0, |sum, digit| (sum + f64::from(digit - b'0')) / 10.0))
    }

    /// Minutes that the clock is ahead of universal time.
    fn offset(&mut self) -> Result<i32, String> {
        let sign = match self.one_of("Zz+-", "the offset from UTC (`Z` or such as `+02:00`)")? {
            '+' => 1,
            '-' => -1,
            _ => return Ok(0),
        };
        let (hours, minutes) = (self.number(2)?, self.after(":", 2)?);
        within("offset's hour", hours, 0, 23)?;
        within("offset's minute", minutes, 0, 59)?;
        Ok(sign * (hours * 60 + minutes))
    }
}

fn within(what: &str, value: i32, lo: i32, hi: i32) -> Result<(), String> {
    if (lo..=hi).contains(&value) { Ok(()) } else { Err(format!("the {what} must be from {lo} to {hi}, not {value}")) }
}

fn days_of_month(year: i32, month: i32) -> i32 {
    match month {
        4 | 6 | 9 | 11 => 30,
        2 if year % 4 == 0 && (year % 100 != 0 || year % 400 == 0) => 29,
        2 => 28,
        _ => 31,
    }
}

/// Days since 1 January 2000 in the Gregorian calendar. The year is taken to begin in March, so that a leap day is its
/// last.
fn day_number(year: i32, month: i32, day: i32) -> i32 {
    let (year, month) = if month > 2 { (year, month - 3) } else { (year - 1, month + 9) };
    let leap_days = year.div_euclid(4) - year.div_euclid(100) + year.div_euclid(400);
    365 * year + leap_days + (153 * month + 2) / 5 + day - 730_426
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn known_days() {
        // Julian days from Meeus, Astronomical Algorithms, 1998, chapter 7, less 2451545.
        for (text, days) in [
            ("2000-01-01T12:00:00Z", 0.0),
            ("1999-01-01T00:00:00Z", -365.5),
            ("1987-01-27T00:00:00Z", -4722.5),
            ("1987-06-19T12:00:00Z", -4579.0),
            ("1900-01-01T00:00:00Z", -36524.5),
            ("1600-12-31T00:00:00Z", -145_732.5),
            ("2000-02-29T12:00:00.5+02:30", 59.0 - 2.5 / 24.0 + 0.5 / 86_400.0),
            ("2016-12-31t23:59:60z", 6209.5),
            ("2003-10-17T12:30:30-07:00", 1385.0 + (7.5 * 3600.0 + 30.0) / 86_400.0),
        ] {
            assert!((days_since_j2000(text).unwrap() - days).abs() < 1e-9, "{text}");
        }
    }

    #[test]
    fn what_is_wrong_is_told() {
        for (text, part) in [
            ("", "4 digits"),
            ("26-06-21T12:00:00Z", "4 digits"),
            ("2026-06-21", "`T`"),
            ("2026-06-21 12:00:00Z", "`T`"),
            ("2026-06-21T12:00Z", "`:`"),
            ("2026-06-21T12:00:00", "offset"),
            ("2026-06-21T12:00:00.Z", "digits"),
            ("2026-06-21T12:00:00+2", "2 digits"),
            ("2026-06-21T12:00:00+25:00", "offset's hour"),
            ("2026-06-21T12:00:00Zoo", "`oo`"),
            ("2026-13-21T12:00:00Z", "month"),
            ("2026-02-29T12:00:00Z", "from 1 to 28"),
            ("2100-02-29T12:00:00Z", "from 1 to 28"),
            ("2026-06-21T24:00:00Z", "hour"),
            ("2026-06-21T12:60:00Z", "minute"),
            ("2026-06-21T12:00:61Z", "second"),
            ("２０２６-06-21T12:00:00Z", "digits"),
            ("2026-0é-21T12:00:00Z", "digits"),
        ] {
            let error = days_since_j2000(text).unwrap_err();
            assert!(error.contains(part), "{text}: {error}");
        }
    }
}
