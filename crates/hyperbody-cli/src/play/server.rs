//! A small web server for one page on one machine.
//!
//! The headers let the page share memory with its workers, which browsers allow only to pages that let nothing of others in.

use std::net::IpAddr;
use std::sync::Arc;
use std::thread;

use tiny_http::{Header, Method, Request, Response, StatusCode};

use super::site::{Content, Site, plain};
use crate::failure::Failure;

/// Requests that are answered at once: a browser asks for some six files together.
const THREADS: usize = 6;

/// A server that listens.
pub(crate) struct Server {
    http: Arc<tiny_http::Server>,
    host: IpAddr,
}

impl Server {
    /// Listens on a port; on `usual` if none is wanted, or on any that is free if that is taken.
    pub(crate) fn start(host: IpAddr, port: Option<u16>, usual: u16) -> Result<Self, Failure> {
        let listen = |port: u16| tiny_http::Server::http((host, port));
        let http = listen(port.unwrap_or(usual)).or_else(|error| if port.is_none() { listen(0) } else { Err(error) });
        let http = http.map_err(|error| {
            let port = port.unwrap_or(usual);
            Failure::Work(format!(
                "cannot serve on {host} port {port}: {error}; another program may have it: choose another with --port, \
                 or --port 0 for any that is free"
            ))
        })?;
        Ok(Self { http: Arc::new(http), host })
    }

    /// The address to open, without a slash at its end.
    pub(crate) fn address(&self) -> String {
        let port = self.http.server_addr().to_ip().map_or(0, |address| address.port());
        match self.host {
            IpAddr::V6(host) => format!("http://[{host}]:{port}"),
            IpAddr::V4(host) => format!("http://{host}:{port}"),
        }
    }

    /// Answers requests until the program is ended.
    pub(crate) fn serve(&self, site: &Site) -> Result<(), Failure> {
        thread::scope(|scope| {
            for _ in 0..THREADS {
                scope.spawn(|| {
                    while let Ok(request) = self.http.recv() {
                        answer(request, site);
                    }
                });
            }
        });
        Err(Failure::Work("the server has stopped".to_owned()))
    }
}

fn answer(request: Request, site: &Site) {
    let response = match request.method() {
        Method::Get | Method::Head => {
            let path = request.url().split(['?', '#']).next().unwrap_or("").trim_start_matches('/');
            match (site.way(path), site.file(path)) {
                (Some(way), _) => header(("Location", way)).into_iter().fold(text(302, ""), Response::with_header),
                (None, Some(_)) if path == WORKER => worker(),
                (None, Some(content)) => {
                    let tag = tag_of(&content.bytes);
                    if is_known(&request, &tag) {
                        unchanged(&tag)
                    } else {
                        let packed = accepts(&request, "br").then(|| site.with_brotli(path)).flatten();
                        file(path, content, packed, accepts(&request, "gzip"), &tag)
                    }
                }
                (None, None) => text(404, "There is no such file here."),
            }
        }
        _ => text(405, "This server only hands out files."),
    };
    // A browser that has gone away is nobody's fault.
    let _ = request.respond(response);
}

type Answer = Response<std::io::Cursor<Vec<u8>>>;

/// What makes an exported page work without a net: the browser's worker between page and server. Here the page comes from
/// this machine, and what the browser keeps must not outlive the program: the worker is answered by one that removes itself.
const WORKER: &str = "sw.js";

fn worker() -> Answer {
    let code = "addEventListener(\"install\", () => skipWaiting());\n\
                const tidy = async () => {\n\
                for (const name of await caches.keys()) if (name.startsWith(\"hyperbody-\")) await caches.delete(name);\n\
                await registration.unregister();\n\
                };\n\
                addEventListener(\"activate\", (event) => event.waitUntil(tidy()));\n";
    let headers = [("Content-Type", mime_type(WORKER)), ("Cache-Control", "no-cache")];
    headers.into_iter().filter_map(header).fold(text(200, code), Response::with_header)
}

/// Names what a file holds (FNV-1a), weakly: it is the same with and without compression.
fn tag_of(bytes: &[u8]) -> String {
    let mix = |hash: u64, byte: &u8| (hash ^ u64::from(*byte)).wrapping_mul(0x0100_0000_01b3);
    format!("W/\"{:016x}\"", bytes.iter().fold(0xcbf2_9ce4_8422_2325, mix))
}

/// Whether the browser has this content already; tags are compared without their mark of weakness (RFC 9110, 13.1.2).
fn is_known(request: &Request, tag: &str) -> bool {
    let opaque = |tag: &str| tag.trim().trim_start_matches("W/").to_owned();
    let mut known = request.headers().iter().filter(|header| header.field.equiv("If-None-Match"));
    known.any(|header| header.value.as_str().split(',').any(|each| opaque(each) == opaque(tag) || each.trim() == "*"))
}

fn unchanged(tag: &str) -> Answer {
    let headers = [("ETag", tag), ("Cache-Control", "no-cache"), ("Vary", "Accept-Encoding")];
    // No type: it would take the place of the one that the browser remembers.
    let response = Response::from_data(Vec::new()).with_status_code(StatusCode(304));
    headers.into_iter().chain(ISOLATION).filter_map(header).fold(response, Response::with_header)
}

/// Sends a file as small as it is here and the browser takes it: with brotli, with gzip, or as it is.
fn file(path: &str, content: Content, brotli: Option<Vec<u8>>, gzip: bool, tag: &str) -> Answer {
    let Content { compressed, bytes, immutable } = content;
    let encoding = if brotli.is_some() { Some("br") } else { (compressed && gzip).then_some("gzip") };
    let Some(bytes) = brotli.or_else(|| plain(compressed && !gzip, &bytes).ok()) else {
        return text(500, "This file is damaged.");
    };
    let caching = if immutable { "public, max-age=31536000, immutable" } else { "no-cache" };
    let mut response = Response::from_data(bytes);
    let mut headers = vec![("Content-Type", mime_type(path)), ("Cache-Control", caching), ("Vary", "Accept-Encoding")];
    headers.push(("ETag", tag));
    headers.extend(encoding.map(|encoding| ("Content-Encoding", encoding)));
    headers.extend(ISOLATION);
    for header in headers.into_iter().filter_map(header) {
        response.add_header(header);
    }
    // Sizes are known; without this, long answers come in chunks.
    response.with_chunked_threshold(usize::MAX)
}

/// What lets a page share memory with its workers, and keeps browsers from guessing types.
const ISOLATION: [(&str, &str); 4] = [
    ("Cross-Origin-Opener-Policy", "same-origin"),
    ("Cross-Origin-Embedder-Policy", "require-corp"),
    ("Cross-Origin-Resource-Policy", "same-origin"),
    ("X-Content-Type-Options", "nosniff"),
];

fn text(status: u16, message: &str) -> Answer {
    let response = Response::from_string(message).with_status_code(StatusCode(status));
    ISOLATION.into_iter().filter_map(header).fold(response, Response::with_header)
}

fn header((name, value): (&str, &str)) -> Option<Header> {
    Header::from_bytes(name, value).ok()
}

/// Whether the browser takes this compression.
fn accepts(request: &Request, encoding: &str) -> bool {
    let mut lists = request.headers().iter().filter(|header| header.field.equiv("Accept-Encoding"));
    let is_it = |each: &str| {
        let (name, weight) = each.split_once(';').unwrap_or((each, ""));
        name.trim().eq_ignore_ascii_case(encoding) && !matches!(weight.trim(), "q=0" | "q=0.0" | "q=0.00" | "q=0.000")
    };
    lists.any(|header| header.value.as_str().split(',').any(is_it))
}

/// By the end of a name.
fn mime_type(path: &str) -> &'static str {
    match path.rsplit('.').next().unwrap_or("") {
        "js" | "mjs" => "text/javascript; charset=utf-8",
        "css" => "text/css; charset=utf-8",
        "wasm" => "application/wasm",
        "json" | "map" => "application/json; charset=utf-8",
        "webmanifest" => "application/manifest+json",
        "svg" => "image/svg+xml",
        "png" => "image/png",
        "jpg" | "jpeg" => "image/jpeg",
        "webp" => "image/webp",
        "avif" => "image/avif",
        "ico" => "image/x-icon",
        "woff2" => "font/woff2",
        "glb" => "model/gltf-binary",
        "txt" => "text/plain; charset=utf-8",
        // The page itself, which has the empty address.
        _ => "text/html; charset=utf-8",
    }
}
