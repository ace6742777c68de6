//! Serves the built page on this machine, as a host should: compressed, and cached for ever where the name changes with the
//! contents.

use anyhow::{Context, Result};
use axum::Router;
use axum::extract::Request;
use axum::http::{HeaderValue, header::CACHE_CONTROL};
use axum::middleware::{Next, from_fn};
use axum::response::Response;
use std::path::Path;
use tokio::net::TcpListener;
use tokio::runtime::Builder;
use tower_http::services::ServeDir;

/// Serves the files of a folder until it is stopped.
pub(crate) fn serve(folder: &Path, address: &str) -> Result<()> {
    Builder::new_current_thread().enable_all().build()?.block_on(async {
        let listener = TcpListener::bind(address).await.with_context(|| address.to_string())?;
        println!("open http://{address}/");
        Ok(axum::serve(listener, files(folder)).await?)
    })
}

/// The files of a folder, with their compressed copies.
fn files(folder: &Path) -> Router {
    let files = ServeDir::new(folder).precompressed_br().precompressed_gzip();
    Router::new().fallback_service(files).layer(from_fn(cached))
}

/// States how long a browser may keep a file. A folder that is named by its contents never changes.
async fn cached(request: Request, next: Next) -> Response {
    let in_folder = request.uri().path().trim_start_matches('/').contains('/');
    let mut response = next.run(request).await;
    let cache = match in_folder && response.status().is_success() {
        true => "public, max-age=31536000, immutable",
        false => "no-cache",
    };
    response.headers_mut().insert(CACHE_CONTROL, HeaderValue::from_static(cache));
    response
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test fails by panicking")]
mod tests {
    use super::{Builder, files};
    use axum::body::{Body, to_bytes};
    use axum::http::{Request, StatusCode};
    use std::fs;
    use tower::ServiceExt;

    #[test]
    fn files_are_sent_compressed_and_cached_by_name() {
        let folder = std::env::temp_dir().join(format!("affinor-serve-{}", std::process::id()));
        fs::create_dir_all(folder.join("page-1")).unwrap();
        for (name, text) in [
            ("index.html", "plain"),
            ("index.html.gz", "zipped"),
            ("page-1/a.js", "plain"),
            ("page-1/a.js.br", "brotli"),
        ] {
            fs::write(folder.join(name), text).unwrap();
        }
        let runtime = Builder::new_current_thread().enable_all().build().unwrap();
        let get = |url: &str, accepted: &str| {
            let request = Request::get(url).header("accept-encoding", accepted);
            let request = request.body(Body::empty()).unwrap();
            let response = runtime.block_on(files(&folder).oneshot(request)).unwrap();
            let header = |name: &str| {
                let value = response.headers().get(name);
                value.and_then(|value| value.to_str().ok()).unwrap_or_default().to_string()
            };
            let headers = ["content-encoding", "cache-control", "content-type"].map(header);
            let status = response.status();
            let body = runtime.block_on(to_bytes(response.into_body(), usize::MAX)).unwrap();
            (status, String::from_utf8(body.to_vec()).unwrap(), headers)
        };
        const FOR_EVER: &str = "public, max-age=31536000, immutable";
        let (status, text, headers) = get("/", "gzip, deflate, br");
        assert_eq!((status, &*text), (StatusCode::OK, "zipped"));
        assert_eq!(headers, ["gzip", "no-cache", "text/html"]);
        let (_, text, headers) = get("/page-1/a.js?x", "gzip;q=0.5, br;q=1");
        assert_eq!(text, "brotli");
        assert_eq!(headers, ["br", FOR_EVER, "text/javascript"]);
        assert_eq!(get("/page-1/a.js", "").1, "plain");
        for outside in ["/../index.html", "/page-1/../../x.js", "/missing.js", "/page-1/missing.js"]
        {
            let (status, _, [_, cache, _]) = get(outside, "");
            assert!(status != StatusCode::OK && cache == "no-cache", "{outside}: {status}");
        }
        fs::remove_dir_all(folder).unwrap();
    }
}
