//! A small server of static files, on this computer only.

use crate::page::beside;
use anyhow::{Result, anyhow, bail};
use std::fs::File;
use std::path::{Component, Path, PathBuf};
use std::sync::Arc;
use tiny_http::{Header, Method, Request, Response, Server, StatusCode};

/// How many requests are answered at once; a browser keeps some six lines open.
const THREADS: usize = 8;

/// What is served, and how.
struct Site {
    folder: PathBuf,
    under: String,
    plain: bool,
}

/// Serves a folder until it is stopped; port 0 is any that is free.
pub(crate) fn serve(folder: &Path, port: u16, under: &str, plain: bool) -> Result<()> {
    if !folder.join("index.html").is_file() {
        bail!("there is no page in {}: build it first, without --built", folder.display());
    }
    let server = Arc::new(listen(port)?);
    let under = under.trim_matches('/').to_owned();
    let path = if under.is_empty() { String::new() } else { format!("{under}/") };
    let port = server.server_addr().to_ip().map_or(port, |address| address.port());
    xtask::workspace::say(&format!("open http://127.0.0.1:{port}/{path} (Ctrl+C stops it)"));
    let site = Arc::new(Site { folder: folder.to_owned(), under, plain });
    let threads: Vec<_> = (0..THREADS)
        .map(|_| {
            let (server, site) = (Arc::clone(&server), Arc::clone(&site));
            std::thread::spawn(move || server.incoming_requests().for_each(|r| site.answer(r)))
        })
        .collect();
    threads.into_iter().try_for_each(|t| t.join().map_err(|_| anyhow!("the server broke down")))
}

fn listen(port: u16) -> Result<Server> {
    Server::http(("127.0.0.1", port)).map_err(|e| match e.downcast_ref::<std::io::Error>() {
        Some(io) if io.kind() == std::io::ErrorKind::AddrInUse => anyhow!(
            "port {port} is taken, perhaps by a page served before; try --serve {}",
            port.checked_add(1).unwrap_or(8080)
        ),
        Some(io) if io.kind() == std::io::ErrorKind::PermissionDenied => {
            anyhow!("port {port} is not for everyone; try --serve 8080")
        }
        _ => anyhow!("cannot serve at port {port}: {e}"),
    })
}

impl Site {
    /// Answers one request; someone who went away needs no answer.
    fn answer(&self, request: Request) {
        let _ = match self.found(&request) {
            Ok((path, file, coding)) => {
                let mut answer = Response::from_file(file);
                for header in self.headers(&path, coding) {
                    answer.add_header(header);
                }
                request.respond(answer)
            }
            Err((status, text)) => {
                request.respond(Response::from_string(text).with_status_code(StatusCode(status)))
            }
        };
    }

    /// The file that is asked for, and how it is compressed.
    fn found(&self, request: &Request) -> Result<(PathBuf, File, Option<&'static str>), Refused> {
        if !matches!(request.method(), Method::Get | Method::Head) {
            return Err((405, "only GET and HEAD\n"));
        }
        let path = self.path(request.url()).ok_or((404, "there is no such file\n"))?;
        let takes = accepted(request);
        let packed = [("br", ".br"), ("gzip", ".gz")].into_iter().find_map(|(coding, ending)| {
            let file = takes.contains(coding).then(|| File::open(beside(&path, ending)).ok())??;
            Some((file, Some(coding)))
        });
        let plain = || Some((File::open(&path).ok()?, None));
        let (file, coding) = packed.or_else(plain).ok_or((404, "there is no such file\n"))?;
        Ok((path, file, coding))
    }

    /// The path of a file in the folder, never out of it.
    fn path(&self, url: &str) -> Option<PathBuf> {
        let asked = url.split(['?', '#']).next()?.trim_start_matches('/');
        let asked = asked.strip_prefix(&self.under)?.trim_start_matches('/');
        let asked = if asked.is_empty() { "index.html" } else { asked };
        let inside = Path::new(asked).components().all(|c| matches!(c, Component::Normal(_)));
        let path = self.folder.join(asked);
        (inside && path.is_file()).then_some(path)
    }

    fn headers(&self, path: &Path, coding: Option<&str>) -> Vec<Header> {
        let mut pairs = vec![
            ("Content-Type", kind(path)),
            ("Cache-Control", "no-cache"),
            ("Vary", "Accept-Encoding"),
        ];
        if let Some(coding) = coding {
            pairs.push(("Content-Encoding", coding));
        }
        if !self.plain {
            // With these, the page may share memory with its workers.
            pairs.push(("Cross-Origin-Opener-Policy", "same-origin"));
            pairs.push(("Cross-Origin-Embedder-Policy", "require-corp"));
            pairs.push(("Cross-Origin-Resource-Policy", "same-origin"));
        }
        pairs.into_iter().filter_map(|(k, v)| Header::from_bytes(k, v).ok()).collect()
    }
}

/// Status and words.
type Refused = (u16, &'static str);

fn accepted(request: &Request) -> String {
    let header = request.headers().iter().find(|h| h.field.equiv("Accept-Encoding"));
    header.map(|h| h.value.as_str().to_ascii_lowercase()).unwrap_or_default()
}

fn kind(path: &Path) -> &'static str {
    match path.extension().and_then(|e| e.to_str()) {
        Some("html") => "text/html; charset=utf-8",
        Some("js") => "text/javascript; charset=utf-8",
        Some("css") => "text/css; charset=utf-8",
        Some("wasm") => "application/wasm",
        Some("svg") => "image/svg+xml",
        Some("png") => "image/png",
        Some("toml" | "txt") => "text/plain; charset=utf-8",
        _ => "application/octet-stream",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn site(under: &str) -> (tempfile::TempDir, Site) {
        let folder = tempfile::tempdir().expect("folder");
        let inner = folder.path().join("page");
        std::fs::create_dir(&inner).expect("folder");
        std::fs::write(inner.join("index.html"), "page").expect("write");
        std::fs::write(folder.path().join("secret"), "secret").expect("write");
        (folder, Site { folder: inner, under: under.into(), plain: false })
    }

    #[test]
    fn nothing_outside_the_folder_is_served() {
        let (_folder, site) = site("");
        assert!(site.path("/").is_some_and(|p| p.ends_with("index.html")));
        assert!(site.path("/index.html?v=1").is_some());
        for url in ["/../secret", "/./../secret", "//etc/passwd", "/%2e%2e/secret", "/absent"] {
            assert_eq!(site.path(url), None, "{url}");
        }
    }

    #[test]
    fn it_can_be_under_a_path() {
        let (_folder, site) = site("some/where");
        assert!(site.path("/some/where/").is_some());
        assert!(site.path("/some/where/index.html").is_some());
        assert_eq!(site.path("/"), None);
    }

    #[test]
    fn a_taken_port_is_told_with_another() {
        let taken = listen(0).expect("a free port");
        let port = taken.server_addr().to_ip().expect("an address").port();
        let Err(told) = listen(port) else { panic!("two servers at one port") };
        assert!(told.to_string().contains("is taken"), "{told}");
    }
}
