//! affinor in the browser: [`call`] answers a request of the page with a report.
//!
//! Requests and answers are JSON. A request has the options of the command line; an answer is the
//! report in a format, or an error message. The page restarts the module after a panic.
//!
//! The crate is built three times. With the feature `tables` it reads inputs and makes the cards of
//! tensors; the page loads this module first. The feature `reports` adds reports in all formats, the
//! structure theory of algebras, properties, equations and motions. A third module contains only
//! `representations`.

mod answer;
#[cfg(feature = "reports")]
mod motion;
#[cfg(feature = "tables")]
mod reading;
#[cfg(feature = "reports")]
mod reports;
#[cfg(feature = "representations")]
mod representations;
mod request;
#[cfg(feature = "reports")]
mod source;
#[cfg(feature = "tables")]
mod tables;
#[cfg(feature = "reports")]
mod transport;
mod words;

pub use answer::{Answer, Refusal};
pub use request::Request;

use wasm_bindgen::prelude::wasm_bindgen;

/// Answers a request: `{"report": "table", "space": "so3", "connection": "zero"}`. `Err` contains a
/// [`Refusal`] as JSON.
///
/// ```
/// let answer = affinor_web::call(r#"{"report": "table", "space": "so3@zero", "show": "ricci", "format": "text"}"#);
/// assert!(answer.unwrap().contains("Ric_11 = Ric_22 = Ric_33 = 1/2"));
/// let refused = affinor_web::call(r#"{"report": "table", "space": "so33"}"#);
/// assert!(refused.unwrap_err().contains("so33"));
/// ```
///
/// # Errors
/// The error message, as JSON.
#[wasm_bindgen]
pub fn call(request: &str) -> Result<String, String> {
    let answer = serde_json::from_str::<Request>(request)
        .map_err(|error| Refusal::new(format!("the request cannot be read: {error}")))
        .and_then(|request| request.answer());
    // plain data cannot fail to serialize
    let written = |value: &serde_json::Value| value.to_string();
    answer.map(|answer| written(&answer.json())).map_err(|refusal| written(&refusal.json()))
}

/// Functions of the page; `stage` shows the current stage while the page waits.
#[cfg(target_arch = "wasm32")]
#[wasm_bindgen]
extern "C" {
    /// Shows the current stage; implemented by the worker.
    fn stage(name: &str);
}

/// Outside the browser, stages are not shown.
#[cfg(not(target_arch = "wasm32"))]
fn stage(_: &str) {}

/// Sends the location and the message of a panic to the console.
#[cfg(target_arch = "wasm32")]
#[wasm_bindgen(start)]
pub fn start() {
    console_error_panic_hook::set_once();
}
