//! Connections: how many, from whom, and for how long each may keep us waiting.

use super::steady::Steady;
use crate::service::limits::Peer;
use crate::service::{Config, Service};
use axum::Router;
use axum::body::Body;
use hyper::Request;
use hyper::body::Incoming;
use hyper::server::conn::http1;
use hyper_util::rt::{TokioIo, TokioTimer};
use std::collections::HashMap;
use std::net::{IpAddr, SocketAddr};
use std::pin::pin;
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;
use tokio::net::{TcpListener, TcpStream};
use tokio::sync::Semaphore;
use tokio::task::JoinSet;
use tower::ServiceExt;

/// Longest head of a request, in bytes, and most header lines.
const LONGEST_HEAD: usize = 32 << 10;
const MOST_HEADERS: usize = 100;

/// Pause when the machine has no descriptor left.
const PAUSE: Duration = Duration::from_millis(100);

/// Takes connections until the service is told to end; then waits for those that are open, but not for ever.
pub async fn accept(listener: TcpListener, app: Router, service: Service) {
    let slots = Arc::new(Semaphore::new(service.config.limits.connections));
    let crowd = Arc::new(Crowd::default());
    let mut open = JoinSet::new();
    loop {
        let slot = tokio::select! {
            slot = Arc::clone(&slots).acquire_owned() => slot,
            () = service.ended() => break,
        };
        let accepted = tokio::select! {
            accepted = listener.accept() => accepted,
            () = service.ended() => break,
        };
        // Those that have ended are of no interest any more.
        while open.try_join_next().is_some() {}
        let (stream, address) = match accepted {
            Ok(accepted) => accepted,
            Err(error) => {
                tracing::warn!(%error, "no connection could be taken");
                tokio::time::sleep(PAUSE).await;
                continue;
            }
        };
        let Some(place) = crowd.enter(address.ip(), &service) else { continue };
        let (app, service) = (app.clone(), service.clone());
        open.spawn(async move {
            serve(stream, address, app, service).await;
            drop((slot, place));
        });
    }
    drop(listener);
    let drained = async { while open.join_next().await.is_some() {} };
    if tokio::time::timeout(Config::span(service.config.limits.drain_timeout), drained).await.is_err() {
        tracing::warn!("some connections did not end in time");
    }
}

async fn serve(stream: TcpStream, address: SocketAddr, app: Router, service: Service) {
    let limits = &service.config.limits;
    // Answers are small; each goes out at once.
    let _ = stream.set_nodelay(true);
    let handler = hyper::service::service_fn(move |mut request: Request<Incoming>| {
        request.extensions_mut().insert(Peer(address));
        app.clone().oneshot(request.map(Body::new))
    });
    let steady = Steady::new(stream, Config::span(limits.write_timeout));
    let connection = http1::Builder::new()
        .timer(TokioTimer::new())
        .header_read_timeout(Config::span(limits.header_timeout))
        .max_headers(MOST_HEADERS)
        .max_header_size(LONGEST_HEAD)
        .serve_connection(TokioIo::new(steady), handler);
    let mut connection = pin!(connection);
    tokio::select! {
        // A client that goes away or is too slow is nobody's fault here.
        _ = connection.as_mut() => return,
        () = service.ended() => connection.as_mut().graceful_shutdown(),
    }
    let _ = connection.await;
}

/// Who has how many connections.
#[derive(Debug, Default)]
struct Crowd(Mutex<HashMap<IpAddr, usize>>);

/// One connection of an address.
struct ConnectionSlot {
    crowd: Arc<Crowd>,
    address: IpAddr,
}

impl Crowd {
    /// A place for one more connection; none where the address has its share. A trusted proxy speaks for many.
    fn enter(self: &Arc<Self>, address: IpAddr, service: &Service) -> Option<ConnectionSlot> {
        let address = address.to_canonical();
        let mut crowd = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let count = crowd.entry(address).or_default();
        if *count >= service.config.limits.connections_per_address && !service.proxies.trusts(address) {
            return None;
        }
        *count += 1;
        Some(ConnectionSlot { crowd: Arc::clone(self), address })
    }
}

impl Drop for ConnectionSlot {
    fn drop(&mut self) {
        let mut crowd = self.crowd.0.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(count) = crowd.get_mut(&self.address) {
            *count -= 1;
            if *count == 0 {
                crowd.remove(&self.address);
            }
        }
    }
}
