//! The address of the lab's page.

use clap::Args;

/// The page that links lead to.
#[derive(Debug, Args)]
pub struct Site {
    /// The address of the lab's page, for links: where `assets/web/build` was put. By default where `assets/web/serve`
    /// shows it.
    #[arg(long, value_name = "URL", default_value = "http://localhost:8000/", value_parser = page_address)]
    pub site: String,
}

/// The address of a page, to which a query can be added.
fn page_address(text: &str) -> Result<String, String> {
    let rest = text.strip_prefix("http://").or_else(|| text.strip_prefix("https://"));
    match rest {
        Some(rest) if !rest.is_empty() && !rest.contains(['?', '#']) => Ok(text.to_owned()),
        _ => Err("write http:// or https:// and the rest, without ? and #".into()),
    }
}
