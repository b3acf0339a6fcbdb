//! A small server of static files, on this computer only.

use crate::page::beside;
use anyhow::{Result, anyhow, bail};
use std::fs::File;
use std::io::{self, ErrorKind, Read, Write};
use std::net::{TcpListener, TcpStream};
use std::path::{Component, Path, PathBuf};
use std::sync::Arc;
use std::time::Duration;

/// How many connections there are at once; others wait in the system's queue. A browser keeps some six open.
const THREADS: usize = 8;

/// How long a connection may say nothing, or take nothing. Browsers open some that they do not use.
const PATIENCE: Duration = Duration::from_secs(5);

/// Longest head (bytes) of a request, and most lines in it.
const LONGEST_HEAD: usize = 16 << 10;
const MOST_HEADERS: usize = 64;

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
    let listener = listen(port)?;
    let under = under.trim_matches('/').to_owned();
    let path = if under.is_empty() { String::new() } else { format!("{under}/") };
    let port = listener.local_addr()?.port();
    xtask::workspace::say(&format!("open http://127.0.0.1:{port}/{path} (Ctrl+C stops it)"));
    let site = Arc::new(Site { folder: folder.to_owned(), under, plain });
    let threads: Vec<_> = (0..THREADS)
        .map(|_| {
            let (listener, site) = (listener.try_clone()?, Arc::clone(&site));
            // Someone who went away needs no answer.
            Ok(std::thread::spawn(move || {
                listener.incoming().flatten().for_each(|mut line| drop(site.answer(&mut line)));
            }))
        })
        .collect::<Result<_>>()?;
    threads.into_iter().try_for_each(|t| t.join().map_err(|_| anyhow!("the server broke down")))
}

fn listen(port: u16) -> Result<TcpListener> {
    TcpListener::bind(("127.0.0.1", port)).map_err(|e| match e.kind() {
        ErrorKind::AddrInUse => anyhow!(
            "port {port} is taken, perhaps by a page served before; try --serve {}",
            port.checked_add(1).unwrap_or(8080)
        ),
        ErrorKind::PermissionDenied => {
            anyhow!("port {port} is not for everyone; try --serve 8080")
        }
        _ => anyhow!("cannot serve at port {port}: {e}"),
    })
}

/// What a request asks for.
struct Asked {
    method: String,
    url: String,
    /// The codings that the browser takes.
    codings: String,
}

/// The head of a request; `None` if it is not one.
fn asked(line: &mut impl Read) -> io::Result<Option<Asked>> {
    let mut head = Vec::new();
    let mut part = [0; 4096];
    while head.len() < LONGEST_HEAD {
        let count = line.read(&mut part)?;
        head.extend_from_slice(&part[..count]);
        let mut headers = [httparse::EMPTY_HEADER; MOST_HEADERS];
        let mut request = httparse::Request::new(&mut headers);
        match request.parse(&head) {
            Ok(httparse::Status::Complete(_)) => {
                let codings =
                    request.headers.iter().find(|h| h.name.eq_ignore_ascii_case("accept-encoding"));
                let codings =
                    codings.map(|h| String::from_utf8_lossy(h.value).to_ascii_lowercase());
                return Ok(request.method.zip(request.path).map(|(method, url)| Asked {
                    method: method.to_owned(),
                    url: url.to_owned(),
                    codings: codings.unwrap_or_default(),
                }));
            }
            Ok(httparse::Status::Partial) if count > 0 => {}
            Ok(httparse::Status::Partial) | Err(_) => return Ok(None),
        }
    }
    Ok(None)
}

impl Site {
    /// Answers one request, and ends the connection.
    fn answer(&self, line: &mut TcpStream) -> io::Result<()> {
        line.set_read_timeout(Some(PATIENCE))?;
        line.set_write_timeout(Some(PATIENCE))?;
        let Some(asked) = asked(line)? else {
            return refuse(line, (400, "Bad Request", "this is not a request\n"));
        };
        match self.found(&asked) {
            Ok((path, mut file, coding)) => {
                let size = file.metadata()?.len();
                write!(line, "HTTP/1.1 200 OK\r\nContent-Length: {size}\r\nConnection: close\r\n")?;
                for (name, value) in self.headers(&path, coding) {
                    write!(line, "{name}: {value}\r\n")?;
                }
                line.write_all(b"\r\n")?;
                if asked.method == "GET" {
                    io::copy(&mut file, line)?;
                }
                line.flush()
            }
            Err(refused) => refuse(line, refused),
        }
    }

    /// The file that is asked for, and how it is compressed.
    fn found(&self, asked: &Asked) -> Result<(PathBuf, File, Option<&'static str>), Refused> {
        const ABSENT: Refused = (404, "Not Found", "there is no such file\n");
        if !["GET", "HEAD"].contains(&&*asked.method) {
            return Err((405, "Method Not Allowed", "only GET and HEAD\n"));
        }
        let path = self.path(&asked.url).ok_or(ABSENT)?;
        let packed = [("br", ".br"), ("gzip", ".gz")].into_iter().find_map(|(coding, ending)| {
            let takes = asked.codings.contains(coding);
            let file = takes.then(|| File::open(beside(&path, ending)).ok())??;
            Some((file, Some(coding)))
        });
        let plain = || Some((File::open(&path).ok()?, None));
        let (file, coding) = packed.or_else(plain).ok_or(ABSENT)?;
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

    fn headers<'a>(&self, path: &Path, coding: Option<&'a str>) -> Vec<(&'static str, &'a str)> {
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
        pairs
    }
}

/// Status, its name, and words.
type Refused = (u16, &'static str, &'static str);

fn refuse(line: &mut impl Write, (status, name, text): Refused) -> io::Result<()> {
    let size = text.len();
    write!(
        line,
        "HTTP/1.1 {status} {name}\r\nContent-Type: text/plain\r\nContent-Length: {size}\r\nConnection: close\r\n\r\n{text}"
    )
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

    /// What a server that serves one connection answers to some bytes.
    fn answered(site: &Site, request: &[u8]) -> String {
        let listener = listen(0).expect("a free port");
        let mut client =
            TcpStream::connect(listener.local_addr().expect("an address")).expect("it");
        client.write_all(request).expect("bytes");
        client.shutdown(std::net::Shutdown::Write).expect("an end");
        let (mut line, _) = listener.accept().expect("a connection");
        drop(site.answer(&mut line));
        drop(line);
        let mut answer = Vec::new();
        // Where bytes are left unread the connection is reset after the answer.
        let _ = client.read_to_end(&mut answer);
        String::from_utf8_lossy(&answer).into_owned()
    }

    #[test]
    fn requests_are_answered_and_what_is_none_is_refused() {
        let (folder, site) = site("");
        std::fs::write(folder.path().join("page/index.html.gz"), "packed").expect("write");
        let get = answered(&site, b"GET / HTTP/1.1\r\nHost: x\r\n\r\n");
        assert!(get.starts_with("HTTP/1.1 200 OK\r\nContent-Length: 4\r\n"), "{get}");
        assert!(
            get.contains("Cross-Origin-Opener-Policy: same-origin")
                && get.ends_with("\r\n\r\npage")
        );
        let packed = answered(&site, b"GET / HTTP/1.1\r\naccept-encoding: GZIP\r\n\r\n");
        assert!(
            packed.contains("Content-Encoding: gzip") && packed.ends_with("packed"),
            "{packed}"
        );
        let head = answered(&site, b"HEAD / HTTP/1.1\r\n\r\n");
        assert!(head.contains("Content-Length: 4") && head.ends_with("\r\n\r\n"), "{head}");
        let long = [b"GET /".to_vec(), vec![b'a'; 40_000]].concat();
        for (request, status) in [
            (&b"POST / HTTP/1.1\r\n\r\n"[..], "405"),
            (b"GET /../secret HTTP/1.1\r\n\r\n", "404"),
            (b"GET / HTTP", "400"),
            (b"\0\0\0", "400"),
            (b"", "400"),
            (&long, "400"),
        ] {
            let found = answered(&site, request);
            assert!(found.starts_with(&format!("HTTP/1.1 {status} ")), "{status}: {found}");
        }
    }

    #[test]
    fn a_taken_port_is_told_with_another() {
        let taken = listen(0).expect("a free port");
        let port = taken.local_addr().expect("an address").port();
        let Err(told) = listen(port) else { panic!("two servers at one port") };
        assert!(told.to_string().contains("is taken"), "{told}");
    }
}
