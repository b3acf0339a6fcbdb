//! The languages of the salon: every text that it shows is a message of a catalogue, `locales/*.ftl`.
//!
//! Catalogues are in the format of [Fluent](https://projectfluent.org). Texts that the library declares (labels of scene keys, names of
//! hair types) are English in their declarations; the other catalogues translate them by name, see [`named`]. Errors of scenes
//! and files are the library's, and English.

use std::borrow::Cow;
use std::cell::RefCell;

use fluent_bundle::{FluentArgs, FluentBundle, FluentResource};

/// The value of a variable in a message.
pub type Argument<'a> = fluent_bundle::FluentValue<'a>;

/// A language of the salon.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Locale {
    /// English, the language of the library.
    #[default]
    English,
    /// French.
    French,
}

impl Locale {
    /// All languages.
    pub const ALL: [Self; 2] = [Self::English, Self::French];

    /// Its BCP 47 tag, such as `fr`.
    #[must_use]
    pub const fn tag(self) -> &'static str {
        match self {
            Self::English => "en",
            Self::French => "fr",
        }
    }

    /// Its name in itself.
    #[must_use]
    pub const fn endonym(self) -> &'static str {
        match self {
            Self::English => "English",
            Self::French => "Français",
        }
    }

    /// The language of a tag, such as `fr-CA` or `fr_FR.UTF-8`; `None` for one that the salon does not speak.
    #[must_use]
    pub fn of(tag: &str) -> Option<Self> {
        let primary = tag.split(['-', '_', '.']).next().unwrap_or_default().to_ascii_lowercase();
        Self::ALL.into_iter().find(|locale| locale.tag() == primary)
    }

    /// The language of the system or the browser; English if it is none of the salon's.
    #[must_use]
    pub fn of_system() -> Self {
        sys_locale::get_locales().find_map(|tag| Self::of(&tag)).unwrap_or_default()
    }

    const fn catalogue(self) -> &'static str {
        match self {
            Self::English => include_str!("../../locales/en.ftl"),
            Self::French => include_str!("../../locales/fr.ftl"),
        }
    }
}

type Bundle = FluentBundle<FluentResource>;

/// A language with its catalogue, and the English one for messages that it lacks.
struct Catalogues {
    locale: Locale,
    own: Bundle,
    english: Bundle,
}

thread_local! {
    /// The catalogues of the window's thread. A window has one thread, and tests that run beside each other have one each.
    static CATALOGUES: RefCell<Catalogues> = RefCell::new(Catalogues::of(Locale::English));
}

fn bundle(locale: Locale) -> Bundle {
    let tag = locale.tag().parse().expect("a tag of a language");
    let mut bundle = Bundle::new(vec![tag]);
    // Without marks of direction around variables, for which the font has no glyphs.
    bundle.set_use_isolating(false);
    // A test parses each catalogue; what can be read of a damaged one is used.
    let resource = FluentResource::try_new(locale.catalogue().to_owned());
    bundle.add_resource_overriding(resource.unwrap_or_else(|(partial, _)| partial));
    bundle
}

impl Catalogues {
    fn of(locale: Locale) -> Self {
        Self { locale, own: bundle(locale), english: bundle(Locale::English) }
    }
}

/// Sets the language of this thread's window.
pub fn set(locale: Locale) {
    if current() != locale {
        CATALOGUES.set(Catalogues::of(locale));
    }
}

/// The language of this thread's window.
#[must_use]
pub fn current() -> Locale {
    CATALOGUES.with_borrow(|catalogues| catalogues.locale)
}

/// The sign between whole numbers and decimals in the language of this thread's window.
fn decimal_sign() -> char {
    match current() {
        Locale::English => '.',
        Locale::French => ',',
    }
}

/// A number that was written with a point, in the language of this thread's window.
#[must_use]
pub fn localized(number: &str) -> String {
    number.replace('.', decimal_sign().encode_utf8(&mut [0; 4]))
}

/// A number with so many decimals, in the language of this thread's window.
#[must_use]
pub fn number(value: f64, decimals: usize) -> String {
    localized(&format!("{value:.decimals$}"))
}

/// The number that somebody typed, with a point or a comma.
#[must_use]
pub fn parse_number(text: &str) -> Option<f64> {
    let plain = |c: char| match c {
        ',' => '.',
        '−' => '-',
        c => c,
    };
    let text: String = text.chars().filter(|c| !c.is_whitespace()).map(plain).collect();
    text.parse().ok().filter(|number: &f64| number.is_finite())
}

/// Formats a message, or an attribute of one (`id.attribute`), of a catalogue; `None` if it is not there.
fn format(bundle: &Bundle, id: &str, args: Option<&FluentArgs<'_>>) -> Option<String> {
    let (id, attribute) = id.split_once('.').map_or((id, None), |(id, name)| (id, Some(name)));
    let message = bundle.get_message(id)?;
    let pattern = match attribute {
        None => message.value()?,
        Some(name) => message.get_attribute(name)?.value(),
    };
    // A variable that is not given shows as its name; a test gives all of them.
    Some(bundle.format_pattern(pattern, args, &mut Vec::new()).into_owned())
}

/// A message by its name, in the language of this thread's window; the name of one that no catalogue has.
#[must_use]
pub fn text(id: &str) -> String {
    text_with(id, &[])
}

/// A message with the values of its variables.
#[must_use]
pub fn text_with(id: &str, values: &[(&'static str, Argument<'_>)]) -> String {
    let args: Option<FluentArgs<'_>> =
        (!values.is_empty()).then(|| values.iter().cloned().collect());
    let found = CATALOGUES.with_borrow(|catalogues| {
        let args = args.as_ref();
        format(&catalogues.own, id, args).or_else(|| format(&catalogues.english, id, args))
    });
    debug_assert!(found.is_some(), "no catalogue has the message {id}");
    found.unwrap_or_else(|| id.to_owned())
}

/// An attribute of a message, such as the help of a button; `None` if it has none.
#[must_use]
pub fn attribute(id: &str, name: &str) -> Option<String> {
    let id = format!("{id}.{name}");
    CATALOGUES.with_borrow(|catalogues| {
        format(&catalogues.own, &id, None).or_else(|| format(&catalogues.english, &id, None))
    })
}

/// A text that the library declares in English, in the language of this thread's window: the message `group-name`, with what is not a letter
/// or a digit in the name as `-`.
#[must_use]
pub fn named<'a>(group: &str, name: &str, english: &'a str) -> Cow<'a, str> {
    CATALOGUES.with_borrow(|catalogues| match catalogues.locale {
        Locale::English => Cow::Borrowed(english),
        _ => format(&catalogues.own, &id_of(group, name), None)
            .map_or(Cow::Borrowed(english), Cow::Owned),
    })
}

/// The name of the message for a name of the library; an attribute stays one.
fn id_of(group: &str, name: &str) -> String {
    let (name, attribute) = name.split_once('#').map_or((name, ""), |(name, rest)| (name, rest));
    let plain = |c: char| if c.is_ascii_alphanumeric() { c.to_ascii_lowercase() } else { '-' };
    let words = name.chars().map(plain).collect::<String>();
    let words = words.split('-').filter(|word| !word.is_empty()).collect::<Vec<_>>().join("-");
    let dot = if attribute.is_empty() { "" } else { "." };
    format!("{group}-{words}{dot}{attribute}")
}

/// A message of the catalogues by its name, with the values of its variables: `tr!("cut-off", grams = "1.2")`.
macro_rules! tr {
    ($id:expr) => { $crate::locale::text($id) };
    ($id:expr, $($name:ident = $value:expr),+ $(,)?) => {
        $crate::locale::text_with(
            $id,
            &[$((stringify!($name), $crate::locale::Argument::from($value))),+],
        )
    };
}

pub(crate) use tr;

#[cfg(test)]
mod tests;
